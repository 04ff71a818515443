"""Texture on a liquid that Python knows, frame by frame, with NumPy arrays in and out.

A drop swings between long and flat and is twisted as it does so, in closed form. Run it as a script, or cell
by cell in an editor that knows "# %%":

    PYTHONPATH=build/release/python python3 examples/texture_in_python.py [EXEMPLAR] [PICTURE.png]

It needs NumPy, and Matplotlib for the picture (Debian: python3-numpy python3-matplotlib).
"""

# %% The liquid: a level set (metres, negative inside) and a velocity (m/s) on the points of a grid
import pathlib
import sys

import numpy as np

import fluidtex

RADIUS = 0.3  # m
VOXEL = 0.025  # m
DT = 1 / 24  # s
SWING, TWIST = 2.4, 3.0  # 1/s; rad/s and metre of height
ORIGIN = np.array([-0.75, -0.75, -0.9])

i, j, k = (np.arange(n) * VOXEL for n in (61, 61, 73))
x, y, z = np.stack(np.meshgrid(i, j, k, indexing="ij")) + ORIGIN[:, None, None, None]


def stretch(t):
    """How long the drop is along z, over what it is at rest; and its rate, 1/s."""
    log = -0.5 * np.cos(SWING * t)
    return np.exp(log), 0.5 * SWING * np.sin(SWING * t)


def liquid(t):
    along, rate = stretch(t)
    across = along**-0.5  # the volume stays
    q = np.stack([x / across, y / across, z / along])
    slope = q / np.array([across, across, along])[:, None, None, None]
    # Zero on the surface; near it a distance. Elsewhere it need be none.
    phi = 0.5 * (np.sum(q * q, axis=0) - RADIUS**2) / np.maximum(np.linalg.norm(slope, axis=0), 1e-6)
    velocity = np.stack([-0.5 * rate * x - TWIST * z * y, -0.5 * rate * y + TWIST * z * x, rate * z], axis=-1)
    return phi, velocity


# %% The texture: one object for a run, one call a frame
root = pathlib.Path(__file__).parent.parent
exemplar = sys.argv[1] if len(sys.argv) > 1 else root / "scenes/exemplars/green_scales.png"
texturer = fluidtex.Texturer(exemplar, points=12000, toroidal=True, settings="texture.coherence = 0.5")

meshes = []
for n in range(31):
    phi, velocity = liquid(n * DT)
    mesh = texturer.frame(phi=phi, velocity=velocity, origin=ORIGIN, voxel=VOXEL, dt=DT)
    meshes.append(mesh)
    age = mesh["age"].mean()
    print(f"frame {n + 1}: {len(mesh['vertices'])} points, {mesh['renewed']:.1%} renewed, age {age:.2f} s")

# %% What comes out are arrays. How far is the texture stretched? The singular values of the gradient of s and
# t, in texels, say so: both are 1 / spacing where it is not.
st_gradient = meshes[-1]["st_gradient"] * meshes[-1]["spacing"] * np.array(texturer.size)[:, None]
widest = 1 / np.linalg.svd(st_gradient, compute_uv=False)[:, -1]
worst = np.quantile(widest, 0.99)
print(f"stretch in the last frame: median {np.median(widest):.2f}, of the worst hundredth {worst:.2f}")

# %% The picture
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from mpl_toolkits.mplot3d.art3d import Poly3DCollection


def draw(axes, mesh, title):
    corners = mesh["vertices"][mesh["triangles"]]
    normal = mesh["normals"][mesh["triangles"]].mean(axis=1)
    light = 0.35 + 0.65 * np.clip(normal @ np.array([0.5, -0.7, 0.5]), 0, 1)
    linear = mesh["color"][mesh["triangles"], :3].mean(axis=1) * light[:, None]
    srgb = np.clip(linear, 0, 1) ** (1 / 2.2)
    axes.add_collection3d(Poly3DCollection(corners, facecolors=srgb, linewidths=0, antialiased=False))
    axes.set(xlim=(-0.4, 0.4), ylim=(-0.4, 0.4), zlim=(-0.5, 0.5), title=title)
    axes.set_box_aspect((0.8, 0.8, 1.0), zoom=1.35)
    axes.view_init(12, -60)
    axes.set_axis_off()


figure = plt.figure(figsize=(12, 4.4), dpi=150)
shown = (0, 10, 20, 30)
for column, n in enumerate(shown):
    draw(figure.add_subplot(1, len(shown), column + 1, projection="3d"), meshes[n], f"{n * DT:.2f} s")
figure.subplots_adjust(0, 0, 1, 0.92, 0, 0)
figure.savefig(sys.argv[2] if len(sys.argv) > 2 else "texture_in_python.png")
