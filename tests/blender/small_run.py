# Writes the folder of a small run by the documented format (docs/reference/files.md), for tests of the
# add-on: a square of SIDE x SIDE points, a texel apart, that moves with a given velocity, textured by a
# picture of noise. Two pieces of texture meet in it, one of them turned by a quarter, and a former place
# fades in its upper part. What is seen of it is computed here once more, from the law that the page gives,
# without the program and without Blender.
import json
import os

import bpy
import numpy as np

TEXELS = 64
STEP = 0.01  # m


def exemplar(path, seed=1, alpha=False, size=TEXELS):
    """A PNG of smooth noise; returns its bytes, size x size x 4, rows from the top."""
    noise = np.random.default_rng(seed).random((size // 8, size // 8, 4))
    pixels = np.kron(noise, np.ones((8, 8, 1)))
    for axis in (0, 1):  # smooth, and going on across the edges
        pixels = sum(np.roll(pixels, shift, axis) for shift in range(-3, 4)) / 7
    pixels = np.round(255 * (0.1 + 0.8 * pixels)).astype(np.uint8)
    if not alpha:
        pixels[..., 3] = 255
    image = bpy.data.images.new("exemplar", size, size, alpha=True)
    image.pixels.foreach_set((pixels[::-1].astype(np.float32) / 255).ravel())
    image.filepath_raw, image.file_format = path, "PNG"
    image.save()
    bpy.data.images.remove(image)
    return pixels


def write_ply(path, vertices, triangles, joints):
    """vertices: {name: array}; joints: (faces, st, fade_st), or None for a file of an older version."""
    names = list(vertices)
    record = np.dtype([(name, "u1" if vertices[name].dtype == np.uint8 else "<f4") for name in names])
    rows = np.zeros(len(vertices["x"]), record)
    for name in names:
        rows[name] = vertices[name]
    text = (
        f"ply\nformat binary_little_endian 1.0\ncomment fluidtex, metres, Z up\nelement vertex {len(rows)}\n"
    )
    text += "".join(f"property {'uchar' if record[name] == np.uint8 else 'float'} {name}\n" for name in names)
    text += f"element face {len(triangles)}\nproperty list uchar int vertex_indices\n"
    faces = np.zeros(len(triangles), [("n", "u1"), ("v", "<i4", 3)])
    faces["n"], faces["v"] = 3, triangles
    blocks = [rows.tobytes(), faces.tobytes()]
    if joints is not None:
        text += f"element joint {len(joints[0])}\nproperty int face\n"
        text += "".join(
            f"property float {fade}{axis}{label}{corner}\n"
            for fade in ("", "fade_")
            for label in range(3)
            for corner in range(3)
            for axis in "st"
        )
        listed = np.zeros(
            len(joints[0]), [("face", "<i4"), ("st", "<f4", (3, 3, 2)), ("fade_st", "<f4", (3, 3, 2))]
        )
        listed["face"], listed["st"], listed["fade_st"] = joints
        blocks.append(listed.tobytes())
    with open(path, "wb") as file:
        file.write(text.encode() + b"end_header\n" + b"".join(blocks))


def decoded(values):
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def encoded(values):
    return np.where(
        values <= 0.0031308, 12.92 * values, 1.055 * np.maximum(values, 1e-9) ** (1 / 2.4) - 0.055
    )


def sampled(image, texel):
    """Bilinear, texel centres at whole numbers, going on across the edges."""
    low = np.floor(texel).astype(int)
    u, v = np.moveaxis(texel - low, -1, 0)[..., None]
    at = lambda dx, dy: image[(low[..., 1] + dy) % image.shape[0], (low[..., 0] + dx) % image.shape[1]]
    return (1 - v) * ((1 - u) * at(0, 0) + u * at(1, 0)) + v * ((1 - u) * at(0, 1) + u * at(1, 1))


class Square:
    """One frame: arrays of the vertices, triangles and joints. Places are in texels, not wrapped."""

    def __init__(self, pixels, side, at, velocity):
        j, i = [grid.ravel() for grid in np.meshgrid(np.arange(side), np.arange(side), indexing="ij")]
        self.pixels, self.velocity = pixels, velocity
        self.position = np.stack([i * STEP + at[0], j * STEP + at[1], np.full(side * side, at[2])], 1)
        a = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)[None]).ravel()
        self.triangles = np.concatenate(
            [np.stack([a, a + 1, a + side + 1], 1), np.stack([a, a + side + 1, a + side], 1)]
        )
        # Left, the piece lies as the picture does; right, turned by a quarter, and across the picture's edge.
        local = np.stack([i, j], 1).astype(float)
        self.right = i >= side // 2
        self.linear = np.where(self.right[:, None, None], [[0, 1], [1, 0]], [[1, 0], [0, -1]]).astype(
            float
        )  # texels a step
        self.texel = np.where(self.right[:, None], [40, 50], [3, 50]) + np.einsum(
            "vab,vb->va", self.linear, local
        )
        self.fade = np.where(j > side // 3, (j - side // 3) / side, 0.0)
        touched = np.zeros(side * side, bool)
        touched[self.triangles[(self.fade[self.triangles] > 0).any(1)]] = True
        turned = np.diag([1.0, -1.0])
        self.former = np.where(touched[:, None], np.array([20, 30]) + local @ turned, self.texel)

        # Of each corner's piece, its place at all three corners: [face, L, C].
        corner = self.triangles
        step = local[corner][:, None] - local[corner][:, :, None]
        fades = (self.fade[corner] > 0).any(1)[:, None, None, None]
        self.places = self.texel[corner][:, :, None] + np.einsum("flab,flcb->flca", self.linear[corner], step)
        self.former_places = np.where(fades, self.former[corner][:, :, None] + step @ turned, self.places)
        whole = lambda places, own: (places == own[corner][:, None]).all((1, 2, 3)) & (
            np.ptp(self.share(own)[corner] % 1, 1) < 0.5
        ).all(1)
        self.joint_faces = np.flatnonzero(
            ~(whole(self.places, self.texel) & whole(self.former_places, self.former))
        )

    def seen(self, faces, weights):
        """Linear RGBA, straight alpha, at barycentric weights in triangles, by the law of
        docs/reference/files.md."""
        rgba = self.pixels / 255.0
        color = np.concatenate([decoded(rgba[..., :3]) * rgba[..., 3:], rgba[..., 3:]], -1)  # premultiplied
        lightness = lambda c: encoded(c[..., :3] @ [0.2126, 0.7152, 0.0722])
        side = TEXELS // 8
        means = lightness(color).reshape(side, 8, side, 8).mean((1, 3))[..., None]

        def layer(places):
            at = np.einsum("pc,plca->pla", weights, places[faces])
            mixed = lambda values: np.einsum("pl,plk->pk", weights, values)
            return mixed(sampled(color, at)), mixed(sampled(means, (at - 3.5) / 8))[:, 0]

        (c1, m1), (c2, m2) = layer(self.places), layer(self.former_places)
        f = np.einsum("pc,pc->p", weights, self.fade[self.triangles[faces]])
        l1, l2 = lightness(c1), lightness(c2)
        wanted = (1 - f) * m1 + f * m2 + np.cos(np.pi / 2 * f) * (l1 - m1) + np.sin(np.pi / 2 * f) * (l2 - m2)
        wanted = np.clip(wanted, np.minimum(l1, l2), np.maximum(l1, l2))
        way = decoded(l1) - decoded(l2)
        along = np.divide(decoded(wanted) - decoded(l2), way, out=np.zeros_like(way), where=way != 0)
        d = (l1 - l2) ** 2
        share = np.where(f > 0, (along * d + 1e-3 * (1 - f)) / (d + 1e-3), 1.0)
        result = c2 + (c1 - c2) * share[:, None]
        result[:, :3] /= result[:, 3:]
        return result

    def seen_at_vertices(self):
        """The same at all vertices."""
        flat = self.triangles.ravel()
        first = np.full(len(self.fade), -1)
        first[flat[::-1]] = np.arange(len(flat))[::-1]
        return self.seen(first // 3, np.eye(3)[first % 3])

    def share(self, texel):
        return (texel + 0.5) / self.pixels.shape[0]

    def write(self, path, more=(), places=True):
        count = len(self.fade)
        shown = self.seen_at_vertices()
        shown = np.round(255 * np.concatenate([encoded(shown[:, :3]), shown[:, 3:]], 1)).astype(np.uint8)
        constant = lambda value: np.full(count, value, np.float32)
        vertices = {
            **dict(zip("xyz", self.position.T)),
            "nx": constant(0),
            "ny": constant(0),
            "nz": constant(1),
            **dict(zip(("red", "green", "blue", "alpha"), shown.T)),
            **dict(zip("st", self.share(self.texel).T % 1)),
            "dx": constant(1),
            "dy": constant(0),
            "dz": constant(0),
            **dict(zip(("bx", "by", "bz"), (self.position - np.array(self.velocity) / 24).T)),
            **dict(zip(("vx", "vy", "vz"), np.tile(self.velocity, (count, 1)).T)),
            "trust": constant(0.75),
            "age": self.position[:, 0].copy(),
            "contact": np.ones(count, np.uint8),
            **dict(zip(("fade_s", "fade_t"), self.share(self.former).T % 1)),
            "fade": self.fade,
        }
        if places:
            for fade in ("", "fade_"):
                for axis in ("sx", "sy", "sz", "tx", "ty", "tz"):
                    vertices[fade + axis] = constant(1)
        vertices.update(more)
        joints = (
            self.joint_faces,
            self.share(self.places[self.joint_faces]),
            self.share(self.former_places[self.joint_faces]),
        )
        write_ply(
            path,
            {name: np.asarray(values) for name, values in vertices.items()},
            self.triangles,
            joints if places else None,
        )


def write_report(folder, picture, frames, **texture):
    with open(os.path.join(folder, "run.json"), "w") as file:
        json.dump(
            {
                "version": "0",
                "scene": {
                    "name": "small",
                    "frames": frames,
                    "frame_rate": 24.0,
                    "texture": {
                        "exemplar": picture,
                        "toroidal": True,
                        "method": "coordinates",
                        "later_frames": "synthesize",
                        "map": [],
                        **texture,
                    },
                    "render": {"roughness": 0.05, "gloss": 1.0, "bump": {"map": "", "height": 1.0}},
                },
                "frames": [{"frame": frame + 1, "spacing": STEP} for frame in range(frames)],
            },
            file,
        )


def write_run(folder, sides=(12, 16, 9), velocity=(0.48, 0.0, 0.0), alpha=False, places=True, **texture):
    """A run of as many frames as there are sides; returns its squares."""
    os.makedirs(os.path.join(folder, "surface"))
    picture = os.path.join(folder, "noise.png")
    pixels = exemplar(picture, alpha=alpha)
    squares = []
    for frame, side in enumerate(sides):
        square = Square(pixels, side, np.array(velocity) * frame / 24, velocity)
        square.write(
            os.path.join(folder, "surface", f"{frame + 1:04d}.ply"),
            {
                "height": square.position[:, 1],
                "fibre_x": square.position[:, 0],
                "fibre_y": square.position[:, 1],
                "fibre_z": square.fade,
            },
            places,
        )
        squares.append(square)
    write_report(folder, picture, len(sides), **texture)
    return squares
