# The whole way, run by Blender with the program itself (variable FLUIDTEX): Blender bakes a liquid, the
# add-on has it textured and shows the result, and Cycles draws what fluidtex has drawn of it.
import json
import os
import subprocess
import sys

import bpy
import numpy as np
from mathutils import Euler, Matrix, Vector

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..", "..")
sys.path[:0] = [HERE, os.path.join(ROOT, "tools", "blender")]
import fluidtex
import mantaflow_scene as mantaflow
from addon_tests import InBlender, baked_difference, run_tests, values

EXEMPLAR = os.path.join(ROOT, "scenes", "exemplars", "green_scales.png")
FRAMES = 4


def pixels(file):
    """height x width x 3, as stored."""
    image = bpy.data.images.load(file)
    result = np.empty(image.size[0] * image.size[1] * 4, np.float32)
    image.pixels.foreach_get(result)
    width, height = image.size
    bpy.data.images.remove(image)
    return result.reshape(height, width, 4)[..., :3]


def blurred(picture, side=4):
    """Means over squares of pixels: without the noise of few samples."""
    height, width, _ = picture.shape
    return (
        picture[: height // side * side, : width // side * side]
        .reshape(height // side, side, width // side, side, 3)
        .mean((1, 3))
    )


def rms(values):
    return np.sqrt((values**2).mean())


class WholeWay(InBlender):
    def bake(self, cells=16):
        """A dam break in a domain that is scaled, turned and moved; returns the domain."""
        scene = mantaflow.empty(FRAMES)
        scene.render.fps = 25
        domain, settings = mantaflow.closed_dam_break(cells, FRAMES, os.path.join(self.folder, "cache"))
        settings.use_mesh = True
        place = Matrix.LocRotScale(Vector((3, -2, 1)), Euler((0, 0, 0.5)), Vector((1.5, 1, 0.8)))
        bpy.context.view_layer.update()
        for thing in scene.objects:
            thing.matrix_world = place @ thing.matrix_world
        for frame in range(1, FRAMES + 1):
            scene.frame_set(frame)
        return domain

    def bounds(self, thing):
        """Of the mesh as it is shown, in the world."""
        shown = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
        mesh = shown.to_mesh()
        points = values(mesh.vertices, "co", 3) @ np.array(shown.matrix_world.to_3x3()).T + np.array(
            shown.matrix_world.translation
        )
        shown.to_mesh_clear()
        return points.min(0), points.max(0)

    def test_a_baked_liquid_is_textured_and_shown_in_its_place(self):
        domain = self.bake()
        scene = bpy.context.scene
        scene.frame_set(3)
        low, high = self.bounds(domain)
        own = domain.fluidtex_texture
        own.exemplar, own.toroidal, own.out = EXEMPLAR, True, os.path.join(self.folder, "textured")
        own.settings = "texture.points=3000"
        bpy.context.view_layer.objects.active = domain
        self.assertEqual(bpy.ops.fluidtex.texture(), {"FINISHED"})
        self.assertEqual(own.status, "done")
        liquid = next(thing for thing in scene.objects if thing.fluidtex.surfaces)
        textured_low, textured_high = self.bounds(liquid)
        cell = 1.5 / 18
        np.testing.assert_allclose(textured_low, low, atol=0.5 * cell)
        np.testing.assert_allclose(textured_high, high, atol=0.5 * cell)
        self.assertTrue(domain.hide_render)
        with open(os.path.join(own.out, "run.json")) as report:
            self.assertEqual(json.load(report)["scene"]["frame_rate"], 25.0)
        self.assertEqual(len(fluidtex.Run(own.out).frames()), FRAMES)
        # Where the liquid is after a frame is where its velocities lead.
        scene.frame_set(4)
        velocity = values(liquid.data.attributes["velocity"].data, "vector", 3)
        moved = values(liquid.data.vertices, "co", 3) - values(
            liquid.data.attributes["previous_position"].data, "vector", 3
        )
        self.assertGreater(np.abs(velocity).max(), 0.3)
        self.assertLess(
            np.sqrt(((velocity / 25 - moved) ** 2).sum(1).mean()), 0.35 * np.sqrt((moved**2).sum(1).mean())
        )
        # The material looks the colours up that fluidtex gave the points: bilinear, where that is cubic.
        liquid.fluidtex.shader = "EMISSION"
        fluidtex.make_material(liquid)
        surface = fluidtex.read_ply(os.path.join(own.out, "surface", "0004.ply"))
        self.assertGreater(len(surface["joint"]), 100)
        self.assertGreater((surface["vertex"]["fade"] > 0).sum(), 30)
        difference = baked_difference(liquid)
        print(
            f"difference of colours at the points: rms {rms(difference):.4f}, most {np.abs(difference).max():.4f}"
        )
        self.assertLess(rms(difference), 0.015)
        self.assertLess(np.abs(difference).max(), 0.08)
        # Once more: the same object is brought up to date.
        bpy.context.view_layer.objects.active = domain
        self.assertEqual(bpy.ops.fluidtex.texture(), {"FINISHED"})
        self.assertEqual(len([thing for thing in scene.objects if thing.fluidtex.surfaces]), 1)

    def test_stopped_work_goes_on(self):
        self.bake()
        out, cache = os.path.join(self.folder, "out"), os.path.join(self.folder, "cache")
        wishes = {"quality": "preview", "settings": ["texture.points=3000"], "frame_rate": 25.0}
        job = fluidtex.Job(cache, EXEMPLAR, out, **wishes)
        while job.frame < 2 and job.running():
            job._reader.join(0.01)
        job.stop()
        with self.assertRaisesRegex(fluidtex.Problem, "stopped"):
            job.check()
        self.assertLess(len(fluidtex.Run(out).frames()), FRAMES)
        fluidtex.texture(cache, EXEMPLAR, out, resume=True, **wishes)
        self.assertEqual(fluidtex.Run(out).frames(), list(range(1, FRAMES + 1)))

    def test_faults_of_the_program_are_told(self):
        self.bake()
        with self.assertRaisesRegex(fluidtex.Problem, "texture.windwos: unknown key"):
            fluidtex.texture(
                os.path.join(self.folder, "cache"),
                EXEMPLAR,
                os.path.join(self.folder, "out"),
                settings=["texture.windwos=3"],
            )

    def test_cycles_draws_what_fluidtex_draws(self):
        self.bake()
        out, cache = os.path.join(self.folder, "out"), os.path.join(self.folder, "cache")
        fine = bpy.data.images.load(EXEMPLAR)
        fine.scale(2 * fine.size[0], 2 * fine.size[1])
        fine.filepath_raw, fine.file_format = os.path.join(self.folder, "fine.png"), "PNG"
        fine.save()
        settings = [
            "texture.points=3000",
            "texture.toroidal=true",
            "texture.between=file",
            f"texture.between_file={fine.filepath_raw}",
            "render.size=[240,136]",
            "render.samples=64",
            "render.ground=true",
        ]
        fluidtex.texture(
            cache,
            EXEMPLAR,
            out,
            quality="preview",
            pictures=True,
            frame_rate=25.0,
            settings=settings,
        )
        again = os.path.join(self.folder, "cycles")
        settings = [word for setting in settings for word in ("--set", setting)]
        subprocess.run(
            [fluidtex.program(), "render", cache, "--exemplar", EXEMPLAR, "--from", out, "--out", again]
            + ["--cycles", "--frames", "4", "--threads", "1", "--quality", "preview", *settings],
            check=True,
        )
        ours, theirs = (pixels(os.path.join(folder, "frames", "0004.png")) for folder in (out, again))
        difference = blurred(ours) - blurred(theirs)
        print(f"difference of pictures: rms {rms(difference):.4f}, mean {difference.mean():.4f}")
        self.assertLess(rms(difference), 0.01)
        self.assertGreater(np.ptp(blurred(ours)), 0.3)


if __name__ == "__main__":
    run_tests(sys.modules["__main__"])
