"""Tests of the Python module, against closed forms."""

import pathlib
import signal
import threading
import unittest

import numpy as np

import fluidtex

SCALES = pathlib.Path(__file__).parents[2] / "scenes/exemplars/green_scales.png"
RADIUS, VOXEL, DT = 0.3, 0.03, 0.05
SPIN = 2.0  # rad/s, about z
MOVE = np.array([0.6, 0.0, 0.0])  # m/s
ORIGIN = np.array([-0.6, -0.6, -0.6])
WINDOWS = "texture.windows = [9, 5]"


def picture(size=64, kind=float):
    """Smooth random colours, the same on each call."""
    random = np.random.default_rng(1).random((size, size, 3))
    for axis in (0, 1):
        random = sum(np.roll(random, shift, axis) for shift in range(-3, 4)) / 7
    random = (random - random.min()) / (random.max() - random.min())
    return (255 * random).astype(np.uint8) if kind is np.uint8 else random


def places():
    i = np.arange(48) * VOXEL
    return ORIGIN + np.stack(np.meshgrid(i, i, i, indexing="ij"), axis=-1)


def ball(t):
    """Level set and velocity of a ball that flies and spins."""
    off = places() - MOVE * t
    velocity = MOVE + SPIN * np.stack([-off[..., 1], off[..., 0], 0 * off[..., 0]], axis=-1)
    return np.linalg.norm(off, axis=-1) - RADIUS, velocity


def grid_frame(t, **more):
    phi, velocity = ball(t)
    return dict(phi=phi, velocity=velocity, origin=ORIGIN, voxel=VOXEL, dt=DT, **more)


def texturer(**more):
    return fluidtex.Texturer(picture(), toroidal=True, **{"points": 2000, "settings": WINDOWS, **more})


class Frames(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        made = texturer()
        cls.frames = [made.frame(**grid_frame(n * DT)) for n in range(3)]

    def test_points_lie_on_the_ball(self):
        for n, mesh in enumerate(self.frames):
            off = mesh["vertices"] - MOVE * n * DT
            np.testing.assert_allclose(np.linalg.norm(off, axis=1), RADIUS, atol=0.1 * VOXEL)
            np.testing.assert_allclose(np.sum(off * mesh["normals"], axis=1) / RADIUS, 1.0, atol=0.01)

    def test_mesh_is_closed(self):
        for mesh in self.frames:
            t = mesh["triangles"]
            edges = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
            self.assertEqual(len(np.unique(edges, axis=0)), len(edges))
            self.assertEqual(len(mesh["vertices"]) - len(edges) // 2 + len(t), 2)

    def test_texture_goes_with_the_motion(self):
        for n in (1, 2):
            mesh = self.frames[n]
            self.assertLess(mesh["renewed"], 0.05)
            self.assertGreater(mesh["explained"], 0.97)
            off = mesh["vertices"] - MOVE * n * DT
            c, s = np.cos(SPIN * DT), np.sin(SPIN * DT)
            back = np.stack([c * off[:, 0] + s * off[:, 1], c * off[:, 1] - s * off[:, 0], off[:, 2]], axis=1)
            before = back + MOVE * (n - 1) * DT
            np.testing.assert_allclose(mesh["previous"], before, atol=0.1 * mesh["spacing"])

    def test_colours_are_looked_up_at_st(self):
        image, mesh = picture(), self.frames[0]
        size = image.shape[0]
        texel = mesh["st"] * size - 0.5
        low = np.floor(texel).astype(int)
        t = (texel - low)[:, :, None]
        at = lambda dx, dy: image[(low[:, 1] + dy) % size, (low[:, 0] + dx) % size]
        x = (1 - t[:, 0]) * at(0, 0) + t[:, 0] * at(1, 0)
        y = (1 - t[:, 0]) * at(0, 1) + t[:, 0] * at(1, 1)
        seen = (1 - t[:, 1]) * x + t[:, 1] * y
        whole = mesh["fade"] == 0
        self.assertGreater(whole.mean(), 0.9)
        np.testing.assert_allclose(mesh["color"][whole, :3], seen[whole], atol=0.08)

    def test_arrays_have_their_shapes(self):
        for mesh in self.frames:
            n = len(mesh["vertices"])
            shapes = {
                "color": (4,),
                "st": (2,),
                "st_gradient": (2, 3),
                "fade_st": (2,),
                "fade": (),
                "orientation": (3,),
                "velocity": (3,),
                "trust": (),
                "age": (),
            }
            for name, shape in shapes.items():
                self.assertEqual(mesh[name].shape, (n, *shape), name)
        np.testing.assert_allclose(np.linalg.norm(self.frames[1]["orientation"], axis=1), 1.0, atol=1e-4)
        self.assertTrue(np.all((self.frames[1]["st"] >= 0) & (self.frames[1]["st"] <= 1)))

    def test_the_same_input_gives_the_same_numbers(self):
        made = texturer()
        for n in range(2):
            again = made.frame(**grid_frame(n * DT))
        np.testing.assert_array_equal(again["color"], self.frames[1]["color"])


class Inputs(unittest.TestCase):
    def test_a_mesh_does_as_a_grid(self):
        made = texturer()
        grid = texturer().frame(**grid_frame(0.0))
        for n in range(2):
            # The textured mesh of a grid is a closed mesh like any other.
            points = grid["vertices"] + MOVE * n * DT
            x, y, z = grid["vertices"].T
            velocity = MOVE + SPIN * np.stack([-y, x, 0 * z], axis=1)
            mesh = made.frame(vertices=points, triangles=grid["triangles"], velocity=velocity, dt=DT)
            off = mesh["vertices"] - MOVE * n * DT
            np.testing.assert_allclose(np.linalg.norm(off, axis=1), RADIUS, atol=0.2 * VOXEL)
        self.assertLess(mesh["renewed"], 0.05)

    def test_a_picture_may_be_a_file_or_bytes(self):
        for exemplar in (SCALES, str(SCALES), picture(kind=np.uint8)):
            mesh = fluidtex.Texturer(exemplar, points=1000, toroidal=True).frame(**grid_frame(0.0))
            self.assertGreater(len(mesh["vertices"]), 800)

    def test_fields_come_back_and_can_be_followed(self):
        t = np.linspace(300.0, 400.0, 48)[None, None, :] + 0 * places()[..., 0]  # rises with z
        settings = (
            WINDOWS
            + """
            texture.scale = { by = "attribute", attribute = "heat", point = [
              { value = 340.0, factor = 1.0 }, { value = 360.0, factor = 2.0 } ] }"""
        )
        grid = texturer(settings=settings).frame(**grid_frame(0.0), fields={"heat": t})
        at = lambda z: 300.0 + 100.0 * (z - ORIGIN[2]) / (47 * VOXEL)
        np.testing.assert_allclose(grid["maps"]["heat"], at(grid["vertices"][:, 2]), atol=0.1)
        wide = grid["maps"]["heat"] > 362
        np.testing.assert_allclose(grid["scale"][wide], 2.0, atol=0.05)
        mesh = texturer().frame(
            vertices=grid["vertices"], triangles=grid["triangles"], fields={"heat": grid["maps"]["heat"]}
        )
        np.testing.assert_allclose(mesh["maps"]["heat"], at(mesh["vertices"][:, 2]), atol=2.0)

    def test_one_surface_is_one_call(self):
        once = fluidtex.texture(picture(), toroidal=True, points=2000, settings=WINDOWS, **grid_frame(0.0))
        np.testing.assert_array_equal(once["color"], texturer().frame(**grid_frame(0.0))["color"])

    def test_spacing_is_that_of_the_points(self):
        mesh = texturer(points=None, spacing=0.03).frame(**grid_frame(0.0))
        self.assertEqual(mesh["spacing"], 0.03)
        self.assertAlmostEqual(len(mesh["vertices"]) * 0.03**2 / (4 * np.pi * RADIUS**2), 1.0, delta=0.1)

    def test_without_liquid_there_is_no_surface(self):
        made = texturer()
        empty = made.frame(phi=np.ones((8, 8, 8)), voxel=0.1)
        self.assertEqual(empty["vertices"].shape, (0, 3))
        self.assertGreater(len(made.frame(**grid_frame(0.0))["vertices"]), 0)

    def test_settings_are_those_of_a_scene(self):
        align = '\ntexture.orientation = { align = "gravity", weight = 1.0 }'
        down = texturer(settings=WINDOWS + align).frame(**grid_frame(0.0))
        side = np.abs(down["normals"][:, 2]) < 0.5
        self.assertGreater(np.mean(down["orientation"][side, 2] < -0.8), 0.9)

    def test_cut_surfaces_have_one_piece_a_triangle(self):
        cut = texturer().frame(**grid_frame(0.0, cut=True))
        whole = texturer().frame(**grid_frame(0.0))
        self.assertGreater(len(cut["vertices"]), len(whole["vertices"]))
        x, st = cut["vertices"][cut["triangles"]], cut["st"][cut["triangles"]]
        longest = lambda corners: np.max(
            np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2), axis=1
        )
        # One texel of 64 is one spacing: no triangle spans much more of the picture than of the surface.
        self.assertLess(
            np.max(longest(st) * 64 * whole["spacing"] - 3.0 * longest(x)), 2.0 * whole["spacing"]
        )


class Faults(unittest.TestCase):
    def refused(self, text, call, *arguments, **more):
        with self.assertRaisesRegex(ValueError, text) as caught:
            call(*arguments, **more)
        self.assertNotIn("\n", str(caught.exception))

    def test_of_a_texturer(self):
        self.refused("nothing.png", fluidtex.Texturer, "nothing.png")
        self.refused("spacing", fluidtex.Texturer, picture(), spacing=0.1, points=100)
        self.refused("^spacing: is -1", fluidtex.Texturer, picture(), spacing=-1.0)
        self.refused("^points: is 0", fluidtex.Texturer, picture(), points=0)
        self.refused("exemplar", fluidtex.Texturer, np.zeros((64, 64, 2)))
        self.refused("exemplar", fluidtex.Texturer, np.full((64, 64, 3), np.nan))
        self.refused("exemplar", fluidtex.Texturer, None)
        self.refused(
            r"^settings:1:9: error: texture.coherance",
            fluidtex.Texturer,
            picture(),
            settings="texture.coherance = 1.0",
        )
        with self.assertRaises(TypeError):
            fluidtex.Texturer(picture(), 0.1)

    def test_of_a_frame(self):
        frame = texturer().frame
        phi, velocity = ball(0.0)
        self.refused("phi, vertices", frame)
        self.refused("voxel", frame, phi=phi)
        self.refused("voxel", frame, phi=phi, voxel=0.0)
        self.refused("dt", frame, phi=phi, voxel=VOXEL, dt=0)
        self.refused("phi: its shape is 48 x 48", frame, phi=phi[0], voxel=VOXEL)
        self.refused("phi: is no array", frame, phi="ball", voxel=VOXEL)
        self.refused("phi: .* not finite", frame, phi=np.where(phi < 0, np.nan, phi), voxel=VOXEL)
        self.refused(r"edge at \[0, 0, 0\]", frame, phi=-phi, voxel=VOXEL)
        self.refused("velocity: its shape is 48 x 48 x 48;", frame, phi=phi, velocity=phi, voxel=VOXEL)
        self.refused("velocity: its shape is 24", frame, phi=phi, velocity=velocity[::2], voxel=VOXEL)
        self.refused("fields: T: its shape is 24", frame, phi=phi, voxel=VOXEL, fields={"T": phi[::2]})
        self.refused("triangles: are missing", frame, vertices=np.zeros((3, 3)))
        self.refused("number 0 has vertex 9", frame, vertices=np.zeros((3, 3)), triangles=[[0, 1, 9]])
        self.refused("triangles: is", frame, vertices=np.zeros((3, 3)), triangles=[[0.0, 1.0, 2.0]])
        self.refused(
            "velocity: there are 1",
            frame,
            vertices=np.zeros((3, 3)),
            triangles=[[0, 1, 2]],
            velocity=np.zeros((1, 3)),
        )

    def test_a_frame_that_fails_leaves_the_last_one(self):
        made, other = texturer(), texturer()
        made.frame(**grid_frame(0.0))
        other.frame(**grid_frame(0.0))
        self.refused("not finite", made.frame, phi=np.full((8, 8, 8), np.inf), voxel=VOXEL)
        one, two = (each.frame(**grid_frame(DT)) for each in (made, other))
        np.testing.assert_array_equal(one["color"], two["color"])

    def test_it_can_be_interrupted(self):
        made = texturer(points=60000)
        timer = threading.Timer(1.0, lambda: signal.raise_signal(signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            made.frame(**grid_frame(0.0))
        timer.join()


if __name__ == "__main__":
    unittest.main()
