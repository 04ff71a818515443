# Tests of the add-on tools/blender/fluidtex.py, run by Blender (tests/blender/CMakeLists.txt):
#   blender -b --factory-startup -t 1 --python-exit-code 1 -P addon_tests.py [-- NAME...]
import os
import shutil
import stat
import sys
import tempfile
import unittest

import bpy
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "..", "tools", "blender")]
import fluidtex
import small_run
from small_run import STEP


def values(collection, key, width, kind=np.float32):
    result = np.empty(len(collection) * width, kind)
    collection.foreach_get(key, result)
    return result.reshape(-1, width) if width > 1 else result


def render(width, height, samples=1, filter_width=0.01, transparent=True):
    """height x width x 4, linear, premultiplied, rows from the bottom."""
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = (
        width,
        height,
        100,
    )
    scene.cycles.samples = samples
    scene.cycles.pixel_filter_type = "GAUSSIAN"
    scene.cycles.filter_width = filter_width
    scene.render.film_transparent = transparent
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_mode = "RGBA"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = os.path.join(bpy.app.tempdir, "picture.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    pixels = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(height, width, 4)


def camera_above(low, high):
    """An orthographic camera that sees the rectangle from straight above."""
    camera = bpy.data.cameras.new("camera")
    camera.type, camera.sensor_fit, camera.ortho_scale = "ORTHO", "HORIZONTAL", high[0] - low[0]
    thing = bpy.data.objects.new("camera", camera)
    thing.location = ((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, 1.0)
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.scene.camera = thing


def baked_difference(liquid):
    """Of the colours that its material emits at the corners of its triangles from those of the vertices,
    sRGB-encoded."""
    mesh = liquid.data
    mesh.color_attributes.active_color = mesh.color_attributes.new("baked", "FLOAT_COLOR", "CORNER")
    for thing in bpy.context.scene.objects:
        thing.select_set(thing == liquid)
    bpy.context.view_layer.objects.active = liquid
    bpy.context.scene.cycles.samples = 1
    bpy.ops.object.bake(type="EMIT", target="VERTEX_COLORS")
    baked = values(mesh.attributes["baked"].data, "color", 4)[:, :3]
    own = values(mesh.attributes["Col"].data, "color", 4)[:, :3][
        values(mesh.loops, "vertex_index", 1, np.int32)
    ]
    return small_run.encoded(baked) - small_run.encoded(own)


def bilinear(grid, x, y):
    """Of a grid at a place, clamped outside; middles at whole numbers."""
    i, j = int(np.floor(x)), int(np.floor(y))
    at = lambda a, b: grid[np.clip(b, 0, grid.shape[0] - 1), np.clip(a, 0, grid.shape[1] - 1)]
    u, v = x - i, y - j
    return (1 - v) * ((1 - u) * at(i, j) + u * at(i + 1, j)) + v * (
        (1 - u) * at(i, j + 1) + u * at(i + 1, j + 1)
    )


class InBlender(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        scene = bpy.context.scene
        scene.render.engine, scene.cycles.device, scene.cycles.use_denoising = "CYCLES", "CPU", False
        scene.frame_start, scene.frame_end = 1, 3
        scene.frame_set(1)
        self.folder = tempfile.mkdtemp(prefix="fluid tex ü%&")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def run_folder(self, name="run", **wishes):
        folder = os.path.join(self.folder, name)
        return folder, small_run.write_run(folder, **wishes)


class Import(InBlender):
    def test_every_frame_has_its_vertices_and_triangles(self):
        folder, squares = self.run_folder()
        liquid = fluidtex.import_run(folder)
        for frame, square in enumerate(squares, 1):
            bpy.context.scene.frame_set(frame)
            mesh = liquid.data
            np.testing.assert_array_equal(values(mesh.vertices, "co", 3), square.position.astype(np.float32))
            np.testing.assert_array_equal(
                values(mesh.loops, "vertex_index", 1, np.int32).reshape(-1, 3), square.triangles
            )
            self.assertFalse(mesh.validate(verbose=True))
            self.assertTrue(values(mesh.polygons, "use_smooth", 1, bool).all())

    def test_every_property_becomes_an_attribute(self):
        folder, squares = self.run_folder()
        liquid = fluidtex.import_run(folder)
        for frame in (3, 1, 2):
            bpy.context.scene.frame_set(frame)
            vertices = fluidtex.read_ply(os.path.join(folder, "surface", f"{frame:04d}.ply"))["vertex"]
            attributes = liquid.data.attributes
            for name, properties, key in (
                ("surface_normal", "nx ny nz", "vector"),
                ("orientation", "dx dy dz", "vector"),
                ("previous_position", "bx by bz", "vector"),
                ("velocity", "vx vy vz", "vector"),
                ("st", "s t", "vector"),
                ("fade_st", "fade_s fade_t", "vector"),
                ("gradient_s", "sx sy sz", "vector"),
                ("fade_gradient_t", "fade_tx fade_ty fade_tz", "vector"),
                ("fibre", "fibre_x fibre_y fibre_z", "vector"),
                ("trust", "trust", "value"),
                ("age", "age", "value"),
                ("contact", "contact", "value"),
                ("fade", "fade", "value"),
                ("height", "height", "value"),
            ):
                wanted = np.stack([vertices[part] for part in properties.split()], 1).astype(np.float32)
                self.assertEqual(attributes[name].domain, "POINT")
                np.testing.assert_array_equal(
                    values(attributes[name].data, key, wanted.shape[1]).reshape(wanted.shape), wanted
                )
            rgba = np.stack([vertices[part] for part in ("red", "green", "blue", "alpha")], 1) / 255
            shown = values(attributes["Col"].data, "color", 4)
            np.testing.assert_allclose(small_run.encoded(shown[:, :3]), rgba[:, :3], atol=1e-5)
            np.testing.assert_allclose(shown[:, 3], rgba[:, 3], atol=1e-6)

    def test_names_that_are_taken_are_told_apart(self):
        folder, (square, *_) = self.run_folder()
        own = {name: square.fade for name in ("exemplar", "position", "corner", "normal", "id", "velocity")}
        square.write(os.path.join(folder, "surface", "0001.ply"), own)
        mesh = fluidtex.import_run(folder).data
        for name in own:
            np.testing.assert_array_equal(
                values(mesh.attributes[name + "_"].data, "value", 1), square.fade.astype(np.float32)
            )
        self.assertIn("exemplar", mesh.uv_layers)

    def test_normals_are_the_runs_own_where_asked_for(self):
        folder, squares = self.run_folder()
        square = squares[1]
        tilted = np.stack(
            [0.6 * np.sin(square.position[:, 0] * 9), np.zeros(len(square.fade)), np.ones(len(square.fade))],
            1,
        )
        tilted /= np.linalg.norm(tilted, axis=1)[:, None]
        square.write(os.path.join(folder, "surface", "0002.ply"), dict(zip(("nx", "ny", "nz"), tilted.T)))
        for custom, wanted in ((True, tilted), (False, np.broadcast_to((0.0, 0.0, 1.0), tilted.shape))):
            mesh = fluidtex.import_run(folder, start=0, custom_normals=custom).data
            if bpy.app.version < (4, 1):
                mesh.calc_normals_split()
                found = values(mesh.loops, "normal", 3)
            else:
                found = values(mesh.corner_normals, "vector", 3)
            np.testing.assert_allclose(found, wanted[square.triangles.ravel()], atol=2e-3)
            np.testing.assert_allclose(
                values(mesh.attributes["surface_normal"].data, "vector", 3), tilted, atol=1e-6
            )

    def test_places_of_joint_triangles_are_those_of_each_corner(self):
        folder, (square, *_) = self.run_folder()
        mesh = fluidtex.import_run(folder).data
        self.assertGreater(len(square.joint_faces), 10)
        self.assertLess(len(square.joint_faces), len(square.triangles))
        others = np.setdiff1d(np.arange(len(square.triangles)), square.joint_faces)
        for names, places in (
            (fluidtex.UV_MAPS, square.places),
            (fluidtex.FORMER_UV_MAPS, square.former_places),
        ):
            for label, name in enumerate(names):
                uv = values(mesh.uv_layers[name].data, "uv", 2).reshape(-1, 3, 2)
                wanted = square.share(places[:, label])
                wanted[..., 1] = 1 - wanted[..., 1]
                np.testing.assert_allclose(uv[square.joint_faces], wanted[square.joint_faces], atol=1e-6)
                # Elsewhere within one repeat of the picture.
                np.testing.assert_allclose((uv - wanted - np.round(uv - wanted))[others], 0, atol=1e-6)
        corner = values(mesh.attributes["corner"].data, "vector", 3)
        np.testing.assert_array_equal(
            corner.reshape(-1, 3, 3), np.broadcast_to(np.eye(3), (len(square.triangles), 3, 3))
        )

    def test_folder_report_and_surface_name_the_same_run(self):
        folder, squares = self.run_folder()
        for part in ("", "run.json", "surface", os.path.join("surface", "0002.ply")):
            liquid = fluidtex.import_run(os.path.join(folder, part))
            self.assertEqual(len(liquid.data.vertices), len(squares[0].fade))
        shutil.copytree(os.path.join(folder, "surface"), os.path.join(folder, "onto"))
        liquid = fluidtex.import_run(os.path.join(folder, "onto", "0001.ply"))
        self.assertTrue(liquid.fluidtex.surfaces.endswith("onto"))
        self.assertEqual(len(liquid.data.vertices), len(squares[0].fade))

    def test_operator_imports_and_selects(self):
        folder, squares = self.run_folder()
        self.assertEqual(
            bpy.ops.fluidtex.import_run(filepath=os.path.join(folder, "surface", "0001.ply"), start=3),
            {"FINISHED"},
        )
        self.assertEqual(bpy.context.object.name, "small")
        bpy.context.scene.frame_set(4)
        self.assertEqual(len(bpy.context.object.data.vertices), len(squares[1].fade))

    def test_what_is_no_run_is_told_in_one_sentence(self):
        folder, _ = self.run_folder()
        file = os.path.join(folder, "surface", "0001.ply")
        with open(file, "rb") as good:
            whole = good.read()
        head = whole.index(b"end_header\n")
        for damaged in (
            whole[:-1],
            whole[:head],
            whole[: len(whole) // 2],
            b"",
            b"ply\nformat ascii 1.0\n",
            whole.replace(b"property list uchar int vertex_indices", b"property list uchar int vertices"),
            whole.replace(b"property float fade_t22\n", b"property float fade_t23\n"),
            whole.replace(b"property float trust", b"property floot trust"),
            whole.replace(b"property float trust", b"property float age"),
            whole.replace(b"element vertex 144", b"element vertex -14"),
            whole.replace(b"element vertex 144", b"element vertex"),
            whole.replace(b"property float x\n", b"property float X\n"),
        ):
            with open(file, "wb") as bad:
                bad.write(damaged)
            with self.assertRaisesRegex(fluidtex.Problem, "0001.ply: .*; "):
                fluidtex.read_ply(file)
        # Whatever is in a file, it is read or refused in one sentence.
        random, refused = np.random.default_rng(7), 0
        for _ in range(400):
            changed = bytearray(whole)
            for _ in range(random.integers(1, 4)):
                changed[
                    random.integers(0, head + 40 if random.random() < 0.8 else len(whole))
                ] = random.integers(0, 256)
            with open(file, "wb") as bad:
                bad.write(changed)
            try:
                fluidtex.read_ply(file)
            except fluidtex.Problem:
                refused += 1
        self.assertGreater(refused, 100)
        with self.assertRaisesRegex(fluidtex.Problem, "holds no surface"):
            fluidtex.import_run(self.folder)
        with self.assertRaisesRegex(RuntimeError, "holds no surface"):
            bpy.ops.fluidtex.import_run(filepath=self.folder)
        with open(os.path.join(folder, "run.json"), "w") as report:
            report.write("{")
        with self.assertRaisesRegex(fluidtex.Problem, "run.json"):
            fluidtex.import_run(folder)
        self.assertEqual(len(bpy.data.objects), 0)


class Timeline(InBlender):
    def count(self, liquid, frame, subframe=0.0):
        bpy.context.scene.frame_set(frame, subframe=subframe)
        return len(liquid.data.vertices)

    def test_frames_beyond_the_ends_hold_or_are_empty(self):
        folder, squares = self.run_folder()
        sizes = [len(square.fade) for square in squares]
        liquid = fluidtex.import_run(folder, start=5)
        self.assertEqual(
            [self.count(liquid, frame) for frame in (1, 5, 6, 7, 8, 50)],
            [sizes[0], *sizes, sizes[2], sizes[2]],
        )
        liquid.fluidtex.beyond = "EMPTY"
        self.assertEqual(
            [self.count(liquid, frame) for frame in (4, 5, 7, 8, 6)], [0, sizes[0], sizes[2], 0, sizes[1]]
        )

    def test_a_frame_without_liquid_is_empty(self):
        folder, squares = self.run_folder()
        square = squares[0]
        names = fluidtex.read_ply(os.path.join(folder, "surface", "0001.ply"))["vertex"].dtype.names
        nothing = np.empty((0, 3, 3, 2))
        small_run.write_ply(
            os.path.join(folder, "surface", "0002.ply"),
            {name: np.empty(0) for name in names},
            np.empty((0, 3)),
            (np.empty(0), nothing, nothing),
        )
        liquid = fluidtex.import_run(folder)
        self.assertEqual(
            [self.count(liquid, frame) for frame in (2, 3, 2, 1)],
            [0, len(squares[2].fade), 0, len(square.fade)],
        )

    def test_loaded_frames_and_moments_between_frames_read_nothing(self):
        folder, _ = self.run_folder()
        liquid = fluidtex.import_run(folder)
        reads, read_ply = [], fluidtex.read_ply
        fluidtex.read_ply = lambda path: reads.append(path) or read_ply(path)
        try:
            self.count(liquid, 1)
            for subframe in (0.25, 0.5, 0.75):
                self.count(liquid, 2, subframe)
            self.assertEqual(reads, [])
            self.count(liquid, 2)
            self.count(liquid, 2)
            self.assertEqual(len(reads), 1)
            os.utime(os.path.join(folder, "surface", "0002.ply"))  # written anew
            self.count(liquid, 2)
            self.assertEqual(len(reads), 2)
        finally:
            fluidtex.read_ply = read_ply

    def test_an_animation_shows_each_frame_with_motion_blur_too(self):
        folder, squares = self.run_folder(velocity=(0.0, 0.0, 0.0))
        fluidtex.import_run(folder, shader="EMISSION")
        camera_above((0, 0), (0.2, 0.2))
        scene = bpy.context.scene
        render(40, 40)  # for its settings
        scene.render.use_motion_blur = True
        scene.render.filepath = os.path.join(self.folder, "film ####")
        scene.frame_set(3)
        bpy.ops.render.render(animation=True)
        for frame, square in enumerate(squares, 1):
            image = bpy.data.images.load(os.path.join(self.folder, f"film {frame:04d}.exr"))
            pixels = np.empty(40 * 40 * 4, np.float32)
            image.pixels.foreach_get(pixels)
            covered = pixels.reshape(-1, 4)[:, 3].mean()
            side = (np.sqrt(len(square.fade)) - 1) * STEP
            self.assertAlmostEqual(covered, side**2 / 0.04, delta=0.03)

    def test_a_missing_folder_is_told_and_the_mesh_stays(self):
        folder, squares = self.run_folder()
        liquid = fluidtex.import_run(folder)
        os.rename(folder, folder + " moved")
        self.assertEqual(self.count(liquid, 2), len(squares[0].fade))
        self.assertRegex(liquid.fluidtex.problem, "is not there")
        os.rename(folder + " moved", folder)
        self.assertEqual(self.count(liquid, 3), len(squares[2].fade))
        self.assertEqual(liquid.fluidtex.problem, "")

    def test_a_saved_file_goes_on_when_opened_and_when_moved(self):
        folder, squares = self.run_folder()
        file = os.path.join(self.folder, "scene.blend")
        bpy.ops.wm.save_as_mainfile(filepath=file)
        liquid = fluidtex.import_run(folder, shader="EMISSION")
        camera_above((0, 0), (0.1, 0.1))
        before = render(8, 8)
        bpy.ops.wm.save_as_mainfile(filepath=file)
        moved = self.folder + " moved"
        os.rename(self.folder, moved)
        self.folder = moved
        bpy.ops.wm.open_mainfile(filepath=os.path.join(moved, "scene.blend"))
        liquid = bpy.data.objects["small"]
        for frame in (2, 3, 1):
            self.assertEqual(self.count(liquid, frame), len(squares[frame - 1].fade))
        np.testing.assert_allclose(render(8, 8), before, atol=1e-3)  # the packed means are half floats


class Material(InBlender):
    def rendered(self, square, pixels=64):
        """A picture from above of the inside of a square, and the triangle and weights below the middle of
        each pixel."""
        low, high = square.position[0, :2], square.position[-1, :2]
        camera_above(low, high)
        picture = render(pixels, pixels)
        at = (
            (np.stack(np.meshgrid(np.arange(pixels), np.arange(pixels)), -1).reshape(-1, 2) + 0.5)
            / pixels
            * (high - low)
            / STEP
        )
        side = int(round(np.sqrt(len(square.fade))))
        cell, inside = np.floor(at).astype(int), at % 1
        lower = inside[:, 0] >= inside[:, 1]
        u, v = inside.T
        faces = cell[:, 1] * (side - 1) + cell[:, 0] + np.where(lower, 0, (side - 1) ** 2)
        weights = np.where(lower[:, None], np.stack([1 - u, u - v, v], 1), np.stack([1 - v, u, v - u], 1))
        return picture.reshape(-1, 4), faces, weights

    def test_colours_follow_the_law_everywhere(self):
        folder, (square, *_) = self.run_folder()
        fluidtex.import_run(folder, shader="EMISSION")
        picture, faces, weights = self.rendered(square)
        wanted = square.seen(faces, weights)
        joint = np.isin(faces, square.joint_faces)
        fading = (weights * square.fade[square.triangles[faces]]).sum(1) > 0
        self.assertGreater((joint & fading).sum(), 100)
        off = np.abs(small_run.encoded(picture[:, :3]) - small_run.encoded(wanted[:, :3])).max(1)
        self.assertGreater(np.ptp(small_run.encoded(wanted[:, :3])), 0.3)
        for where in (~joint & ~fading, joint & ~fading, ~joint & fading, joint & fading):
            self.assertLess(np.sqrt((off[where] ** 2).mean()), 0.003)
            self.assertLess(off[where].max(), 0.02)

    def test_colours_of_a_picture_that_is_see_through(self):
        folder, (square, *_) = self.run_folder(alpha=True)
        fluidtex.import_run(folder, shader="EMISSION")
        picture, faces, weights = self.rendered(square)
        wanted = square.seen(faces, weights)
        self.assertGreater(np.ptp(wanted[:, 3]), 0.3)
        # One sample a pixel is let through or not; its light is that of the colour times alpha.
        self.assertLess(abs(picture[:, 3].mean() - wanted[:, 3].mean()), 0.02)
        lit = wanted[:, :3] * wanted[:, 3:]
        self.assertLess(np.abs(picture[:, :3].mean(0) - lit.mean(0)).max(), 0.02)

    def test_baked_colours_are_those_of_the_vertices(self):
        folder, _ = self.run_folder()
        self.assertLess(np.abs(baked_difference(fluidtex.import_run(folder, shader="EMISSION"))).max(), 0.01)

    def test_without_places_the_colours_of_the_vertices_are_shown(self):
        for wishes in ({"places": False}, {"method": "kwatra07"}, {"later_frames": "advect"}):
            folder, (square, *_) = self.run_folder(str(wishes)[2:8], **wishes)
            liquid = fluidtex.import_run(folder, shader="EMISSION")
            picture, faces, weights = self.rendered(square)
            corners = values(liquid.data.attributes["Col"].data, "color", 4)[square.triangles[faces]]
            np.testing.assert_allclose(picture, np.einsum("pc,pcr->pr", weights, corners), atol=1e-3)
            with self.assertRaisesRegex(fluidtex.Problem, "needs places"):
                liquid.fluidtex.roughness_map = os.path.join(folder, "noise.png")
                fluidtex.make_material(liquid)
            bpy.data.objects.remove(liquid)

    def test_a_missing_exemplar_is_told_and_can_be_named(self):
        folder, _ = self.run_folder()
        os.rename(os.path.join(folder, "noise.png"), os.path.join(folder, "other.png"))
        liquid = fluidtex.import_run(folder)
        self.assertRegex(liquid.fluidtex.problem, "exemplar is not there")
        liquid.fluidtex.exemplar = os.path.join(folder, "other.png")
        fluidtex.make_material(liquid)
        self.assertEqual(liquid.fluidtex.problem, "")
        self.assertIn("fluidtex colours of other.png repeated", bpy.data.node_groups)
        shutil.copy(os.path.join(folder, "other.png"), os.path.join(folder, "exemplar.png"))
        self.assertEqual(fluidtex.Run(folder).exemplar, os.path.join(folder, "exemplar.png"))
        self.assertEqual(fluidtex.import_run(folder).fluidtex.problem, "")
        liquid.fluidtex.color_map = os.path.join(folder, "run.json")
        with self.assertRaisesRegex(fluidtex.Problem, "is no picture"):
            fluidtex.make_material(liquid)

    def test_a_finer_colour_map_takes_the_exemplars_place(self):
        folder, (square, *_) = self.run_folder()
        fine = np.kron(square.pixels, np.ones((4, 4, 1))).astype(np.uint8)
        image = bpy.data.images.new("fine", 256, 256)
        image.pixels.foreach_set((fine[::-1].astype(np.float32) / 255).ravel())
        image.filepath_raw, image.file_format = os.path.join(folder, "fine.png"), "PNG"
        image.save()
        bpy.data.images.remove(image)
        fluidtex.import_run(folder, shader="EMISSION", color_map=os.path.join(folder, "fine.png"))
        picture, faces, weights = self.rendered(square)
        wanted = square.seen(faces, weights)
        # Steps of four pixels in place of interpolation, from the same texels.
        off = np.abs(small_run.encoded(picture[:, :3]) - small_run.encoded(wanted[:, :3]))
        self.assertLess(off.mean(), 0.02)
        self.assertEqual(bpy.data.images["fluidtex means of fine.png"].size[0], small_run.TEXELS // 8)

    def test_means_of_a_picture_of_any_size_lie_where_they_should(self):
        width, height, pixels = 20, 12, 40
        grey = np.random.default_rng(3).random((height, width)).astype(np.float32)
        image = bpy.data.images.new("grey", width, height, is_data=True, float_buffer=True)
        image.pixels.foreach_set(np.stack([grey] * 3 + [np.ones_like(grey)], 2)[::-1].ravel())
        lightness = small_run.encoded(grey)
        for _ in range(3):  # 20 x 12, 10 x 6, 5 x 3, 3 x 2: where one is left over it counts twice
            rows, columns = lightness.shape
            even = np.pad(lightness, ((0, rows % 2), (0, columns % 2)), mode="edge")
            lightness = even.reshape(len(even) // 2, 2, -1, 2).mean((1, 3))
        means, extent = fluidtex._mean_lightness(image, 20, False)
        self.assertEqual(tuple(means.size), (3, 2))
        bpy.ops.mesh.primitive_plane_add(size=1.0, location=(0.5, 0.5, 0.0))
        material = bpy.data.materials.new("means")
        material.use_nodes = True
        nodes = fluidtex.Nodes(material.node_tree)
        emission = nodes.new("ShaderNodeEmission")
        nodes.put(
            fluidtex._look_up(nodes, means, "UVMap", False, extent).outputs["Color"], emission.inputs["Color"]
        )
        nodes.put(emission.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
        bpy.context.object.data.materials.append(material)
        camera_above((0, 0), (1, 1))
        picture = render(pixels, pixels)[::-1, :, 0]
        at = (np.arange(pixels) + 0.5) / pixels
        x, y = [
            ((at * size - 0.5) - 3.5) / 8 for size in (20, 12)
        ]  # texels have their middles at whole numbers
        wanted = [[bilinear(lightness, u, v) for u in x] for v in y]
        np.testing.assert_allclose(picture, wanted, atol=2e-3)

    def test_normals_of_a_map_turn_with_each_piece(self):
        folder, (square, *_) = self.run_folder()
        tilted = np.full((8, 8, 4), 255, np.uint8)
        tilted[..., :3] = (217, 128, 217)  # leans to the picture's right by 45 degrees
        image = bpy.data.images.new("tilted", 8, 8)
        image.pixels.foreach_set((tilted.astype(np.float32) / 255).ravel())
        image.filepath_raw, image.file_format = os.path.join(folder, "tilted.png"), "PNG"
        image.save()
        liquid = fluidtex.import_run(folder, normal_map=image.filepath_raw)
        tree = liquid.data.materials[0].node_tree
        group = next(node for node in tree.nodes if node.type == "GROUP" and "Normal" in node.outputs)
        emission = tree.nodes.new("ShaderNodeEmission")
        tree.links.new(group.outputs["Normal"], emission.inputs["Color"])
        output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
        tree.links.new(emission.outputs[0], output.inputs["Surface"])
        picture, faces, _ = self.rendered(square)
        fades = (square.fade[square.triangles[faces]] > 0).any(1)
        right = square.right[square.triangles[faces]]
        half = np.sqrt(0.5)
        # Emission shows no negative numbers; both directions have none.
        for where, wanted in (
            (~right.any(1) & ~fades, (half, 0, half)),
            (right.all(1) & ~fades, (0, half, half)),
        ):
            self.assertGreater(where.sum(), 100)
            self.assertLess(np.abs(picture[where][:, :3] - wanted).max(), 0.02)

    def test_every_map_has_its_place_in_the_material(self):
        folder, _ = self.run_folder()
        picture = os.path.join(folder, "noise.png")
        liquid = fluidtex.import_run(folder)
        own = liquid.fluidtex
        for name in ("roughness", "normal", "bump", "displacement", "alpha"):
            setattr(own, f"{name}_map", picture)
        own.bump_distance, own.displacement_scale, own.normal_strength = 0.02, 0.03, 0.5
        for shader in ("COAT", "EMISSION", "PRINCIPLED"):
            own.shader = shader
            bpy.context.view_layer.objects.active = liquid
            self.assertEqual(bpy.ops.fluidtex.material(), {"FINISHED"})
        self.assertEqual(len(bpy.data.materials), 1)
        tree = liquid.data.materials[0].node_tree
        principled = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
        for name in ("Base Color", "Roughness", "Normal"):
            self.assertTrue(principled.inputs[name].is_linked, name)
        output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
        displacement = output.inputs["Displacement"].links[0].from_node
        self.assertAlmostEqual(displacement.inputs["Scale"].default_value, 0.03)
        bump = principled.inputs["Normal"].links[0].from_node
        self.assertAlmostEqual(bump.inputs["Distance"].default_value, 0.02)
        self.assertEqual(output.inputs["Surface"].links[0].from_node.type, "MIX_SHADER")
        camera_above((0, 0), (0.1, 0.1))
        self.assertTrue(np.isfinite(render(16, 16)).all())

    def test_the_relief_of_the_run_is_taken(self):
        folder, _ = self.run_folder(map=[{"name": "height", "file": "", "holds": "values"}])
        import json

        file = os.path.join(folder, "run.json")
        with open(file) as report:
            report = json.load(report)
        report["scene"]["texture"]["map"][0]["file"] = os.path.join(folder, "noise.png")
        report["scene"]["render"]["bump"] = {"map": "height", "height": 3.0}
        with open(file, "w") as out:
            json.dump(report, out)
        shutil.copytree(os.path.join(folder, "surface"), os.path.join(folder, "onto"))
        for path in (folder, os.path.join(folder, "onto")):
            own = fluidtex.import_run(path).fluidtex
            self.assertFalse(own.by_points)
            self.assertEqual(own.bump_map, os.path.join(folder, "noise.png"))
            self.assertAlmostEqual(own.bump_distance, 3 * STEP, 6)


class MotionBlur(InBlender):
    def streak(self, shutter, fps=24, speed=0.48, start=1):
        """By how much longer a square looks whose surface moves along x, and by how far its middle is moved,
        m."""
        folder, squares = self.run_folder(
            f"run {shutter} {fps}", velocity=(speed, 0.0, 0.0), sides=(12, 9, 16)
        )
        scene = bpy.context.scene
        fluidtex.import_run(folder, shader="EMISSION")
        scene.render.fps = fps
        scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, shutter
        scene.frame_set(2)
        square = squares[1]
        low, high = square.position[:, 0].min(), square.position[:, 0].max()
        camera_above((low - 0.06, 0.0), (high + 0.06, 0.02))
        scene.cycles.motion_blur_position = "CENTER"
        picture = render(200, 4, samples=64)[..., 3].mean(0)  # share of the time that each column was covered
        at = low - 0.06 + (np.arange(200) + 0.5) / 200 * (high - low + 0.12)
        covered = at[picture > 0.005]
        return np.ptp(covered) - (high - low), (picture * at).sum() / picture.sum() - (low + high) / 2

    def test_streaks_are_as_long_as_the_way_in_the_shutter(self):
        for shutter in (0.5, 1.0, 2.0):
            with self.subTest(shutter):
                self.setUp()
                longer, moved = self.streak(shutter)
                self.assertAlmostEqual(longer, 0.02 * shutter, delta=0.02 * shutter * 0.1 + 0.001)
                self.assertLess(abs(moved), 0.001)  # centred on the frame

    def test_another_frame_rate_keeps_the_way_a_frame(self):
        longer, _ = self.streak(1.0, fps=60)
        self.assertAlmostEqual(longer, 0.02, delta=0.003)


class Texture(InBlender):
    def program(self, text):
        """A stand-in for the program, which says and does what a test wants."""
        file = os.path.join(self.folder, "fluidtex")
        with open(file, "w") as out:
            out.write("#!/bin/bash\n" + text)
        os.chmod(file, os.stat(file).st_mode | stat.S_IXUSR)
        before = os.environ.get("FLUIDTEX")
        os.environ["FLUIDTEX"] = file
        self.addCleanup(
            lambda: os.environ.__setitem__("FLUIDTEX", before) if before else os.environ.pop("FLUIDTEX")
        )

    def test_the_command_says_all_that_is_chosen(self):
        self.program('printf "%s\\n" "$@" > "${0%/*}/said"\necho "frame 7/7: done" >&2\n')
        told = []
        fluidtex.texture(
            self.folder,
            HERE,
            "some where",
            told.append,
            quality="final",
            settings=["texture.spacing=0.01"],
            frame_rate=24000 / 1001,
            frames="1:7",
            resume=True,
        )
        with open(os.path.join(self.folder, "said")) as said:
            words = said.read().split("\n")[:-1]
        self.assertEqual(
            words,
            [
                "texture",
                self.folder,
                "--exemplar",
                HERE,
                "--out",
                "some where",
                "--quality",
                "final",
                "--set",
                "frame_rate=23.976023976023978",
                "--set",
                "texture.spacing=0.01",
                "--frames",
                "1:7",
                "--resume",
                "--no-render",
            ],
        )

    def test_progress_is_told(self):
        self.program('for f in 1 2 3; do echo "frame $f/3: 5 s; 1 s left" >&2; sleep 0.5; done\n')
        told = []
        fluidtex.texture(self.folder, HERE, "out", told.append)
        self.assertEqual(told, [f"fluidtex: frame {frame} of 3" for frame in (1, 2, 3)])

    def test_faults_are_told_with_the_programs_sentence(self):
        self.program('echo "warning: this" >&2; echo "error: lava.jpg: is no picture" >&2; exit 1\n')
        with self.assertRaisesRegex(fluidtex.Problem, "^fluidtex texture: lava.jpg: is no picture$"):
            fluidtex.texture(self.folder, HERE, "out")
        with self.assertRaisesRegex(fluidtex.Problem, "no such picture"):
            fluidtex.texture(self.folder, "nothing.jpg", "out")
        os.environ["FLUIDTEX"] = "/nowhere"
        with self.assertRaisesRegex(fluidtex.Problem, "Preferences"):
            fluidtex.texture(self.folder, HERE, "out")

    def test_stopping_is_as_ctrl_c(self):
        self.program('trap "exit 130" INT\necho "frame 1/9: x" >&2\nwhile true; do sleep 0.05; done\n')
        job = fluidtex.Job(self.folder, HERE, "out")
        while job.frame == 0:
            pass
        job.stop()
        with self.assertRaisesRegex(fluidtex.Problem, "stopped"):
            job.check()
        self.assertFalse(job.running())

    def test_domains_of_liquids_are_known_by_their_physics(self):
        bpy.ops.mesh.primitive_cube_add()
        domain = bpy.context.object
        self.assertIsNone(fluidtex.cache_of(domain))
        self.assertFalse(bpy.ops.fluidtex.texture.poll())
        bpy.ops.object.modifier_add(type="FLUID")
        domain.modifiers[0].fluid_type = "DOMAIN"
        self.assertIsNone(fluidtex.cache_of(domain))  # of gas
        domain.modifiers[0].domain_settings.domain_type = "LIQUID"
        domain.modifiers[0].domain_settings.cache_directory = self.folder
        self.assertEqual(fluidtex.cache_of(domain), self.folder)
        self.assertTrue(bpy.ops.fluidtex.texture.poll())
        with self.assertRaisesRegex(RuntimeError, "a picture is missing"):
            bpy.ops.fluidtex.texture()

    def test_the_first_frame_is_that_of_the_cache(self):
        for name in (
            "data/fluid_data_0010.vdb",
            "data/fluid_data_0011.vdb",
            "mesh/fluid_mesh_0011.bobj.gz",
            "config/x",
        ):
            os.makedirs(os.path.dirname(os.path.join(self.folder, name)), exist_ok=True)
            open(os.path.join(self.folder, name), "w").close()
        self.assertEqual(fluidtex.first_number(self.folder), 11)
        shutil.rmtree(os.path.join(self.folder, "mesh"))
        self.assertEqual(fluidtex.first_number(self.folder), 10)


def run_tests(module):
    """All tests of a module, or those named behind --."""
    fluidtex.register()
    names = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    suite = unittest.TestSuite()
    for each in vars(module).values():
        if (
            isinstance(each, type)
            and issubclass(each, unittest.TestCase)
            and each.__module__ == "__main__"
            and each is not InBlender
        ):
            suite.addTests(unittest.defaultTestLoader.loadTestsFromTestCase(each))
    if names:
        suite = unittest.TestSuite(test for test in suite if any(name in test.id() for name in names))
    result = unittest.TextTestRunner(verbosity=2).run(suite)
    # Blender ends with 0 whatever a test says, unless it is told so.
    sys.exit(0 if result.wasSuccessful() and result.testsRun else 1)


if __name__ == "__main__":
    run_tests(sys.modules["__main__"])
