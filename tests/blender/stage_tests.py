# Tests of what surrounds a run's liquid when Cycles draws it (tools/blender/stage.py, solids.py), run by
# Blender.
import json
import math
import os
import shutil
import sys
import unittest

import bmesh
import bpy
import numpy as np
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "..", "tools", "blender")]
import fluidtex
import render as cycles
import solids
import stage
from addon_tests import InBlender, render, run_tests

SCENE = {
    "name": "small",
    "frames": 5,
    "frame_rate": 20.0,
    "motion": {"flow": "solver"},
    "domain": {
        "size": [2.0, 1.0, 1.0],
        "sides": {f"{axis}_{side}": "wall" for axis in "xyz" for side in ("low", "high")},
    },
    "camera": {"from": [3.0, -4.0, 2.5], "at": [1.0, 0.5, 0.3], "fov": 40.0, "turn": 80.0},
    "light": {
        "sun_direction": [0.0, 0.0, 2.0],
        "sun_color": [1.5, 1.0, 0.5],
        "sun_size": 4.0,
        "sky_color": [0.2, 0.3, 0.5],
        "horizon_color": [0.8, 0.7, 0.6],
    },
    "render": {
        "size": [64, 48],
        "samples": 1,
        "bounces": 2,
        "gloss": 1.0,
        "roughness": 0.05,
        "exposure": 1.0,
        "ground": False,
        "ground_color": [0.7, 0.7, 0.7],
        "tank": False,
        "tank_color": [0.1, 0.1, 0.1],
        "bump": {"map": "", "height": 1.0},
    },
    "texture": {
        "exemplar": "",
        "toroidal": True,
        "method": "coordinates",
        "later_frames": "synthesize",
        "map": [],
    },
}


def scene(**changes):
    return {**json.loads(json.dumps(SCENE)), **changes}


def solid(shape, **more):
    return {
        "name": "solid 0",
        **shape,
        "from": 0.0,
        "until": None,
        "visible": True,
        "color": [0.5, 0.25, 0.1],
        "pivot": [0, 0, 0],
        "axis": [0, 0, 1],
        "keyframe": [],
        **more,
    }


def volume(thing):
    mesh = bmesh.new()
    mesh.from_object(thing, bpy.context.evaluated_depsgraph_get())
    bmesh.ops.recalc_face_normals(mesh, faces=mesh.faces)
    result = mesh.calc_volume()
    closed = all(edge.is_manifold for edge in mesh.edges)
    mesh.free()
    return result, closed


class Camera(InBlender):
    def test_points_are_seen_where_the_runs_own_camera_sees_them(self):
        wide = scene()
        current = bpy.context.scene
        current.render.resolution_x, current.render.resolution_y = 64, 48
        camera = stage.add_camera(wide)
        for frame in (1, 3, 5):
            current.frame_set(frame)
            angle = math.radians(80) * (frame - 1) / 4
            arm = np.array([2.0, -4.5, 2.2])
            arm = np.array(
                [
                    math.cos(angle) * arm[0] - math.sin(angle) * arm[1],
                    math.sin(angle) * arm[0] + math.cos(angle) * arm[1],
                    arm[2],
                ]
            )
            at = np.array([1.0, 0.5, 0.3])
            forward = -arm / np.linalg.norm(arm)
            right = np.cross(forward, [0, 0, 1])
            right /= np.linalg.norm(right)
            up = np.cross(right, forward)
            for x in ((0, 0, 0), (2, 1, 1), (0.3, 0.9, 0.2)):
                way = np.array(x) - (at + arm)
                plane = np.array([way @ right, way @ up]) / (way @ forward) / math.tan(math.radians(20)) / 2
                seen = world_to_camera_view(current, camera, Vector(x))
                np.testing.assert_allclose(seen[:2], [0.5 + plane[0] * 48 / 64, 0.5 + plane[1]], atol=1e-5)

    def test_straight_down_y_is_up_in_the_picture(self):
        camera = stage.add_camera(scene(camera={"from": [1, 1, 5], "at": [1, 1, 0], "fov": 30, "turn": 0}))
        bpy.context.view_layer.update()
        up = camera.matrix_world.to_3x3() @ Vector((0, 1, 0))
        np.testing.assert_allclose(up, (0, 1, 0), atol=1e-6)


class Light(InBlender):
    def look(self, direction):
        """The light that comes from a direction, or from what lies there."""
        data = bpy.data.cameras.new("look")
        data.angle = 0.01
        camera = bpy.data.objects.new("look", data)
        bpy.context.scene.collection.objects.link(camera)
        camera.rotation_euler = Vector(direction).to_track_quat("-Z", "Y").to_euler()
        camera.location.z = 1.0
        bpy.context.scene.camera = camera
        bpy.context.scene.render.film_transparent = False
        return render(4, 4, samples=64, transparent=False)[..., :3].mean((0, 1))

    def test_the_sky_is_that_of_the_scene(self):
        stage.add_light(scene())
        zenith, horizon = np.array([0.2, 0.3, 0.5]), np.array([0.8, 0.7, 0.6])
        for z in (-0.5, 0.0, 0.3, 0.8):
            direction = (math.sqrt(1 - z * z) * 0.6, math.sqrt(1 - z * z) * 0.8, z)
            share = (1 - max(z, 0)) ** 3
            np.testing.assert_allclose(self.look(direction), zenith + share * (horizon - zenith), atol=4e-3)

    def test_a_matt_plane_has_the_radiance_of_sun_and_sky(self):
        dim = scene()
        dim["light"]["sky_color"] = dim["light"]["horizon_color"] = [0.1, 0.1, 0.1]
        stage.add_light(dim)
        mesh = bpy.data.meshes.new("plane")
        mesh.from_pydata([(-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)], [], [(0, 1, 2, 3)])
        mesh.materials.append(stage._matt("matt", (0.5, 0.5, 0.5)))
        stage._link("plane", mesh)
        seen = self.look((0, 0, -1))
        np.testing.assert_allclose(seen, 0.5 * (np.array([1.5, 1.0, 0.5]) / math.pi + 0.1), rtol=0.02)


class Solids(InBlender):
    low, high = Vector((0, 0, 0)), Vector((2, 1, 1))

    def test_shapes_have_their_volumes(self):
        box = {"box": {"min": [0.2, 0.2, 0.0], "max": [0.8, 0.6, 0.5]}}
        ball = {"sphere": {"center": [1.0, 0.5, 0.5], "radius": 0.3}}
        rod = {"cylinder": {"from": [0.5, 0.5, 0.1], "to": [1.1, 0.5, 0.9], "radius": 0.1}}
        plane = {"half_space": {"point": [0.0, 0.0, 0.25], "normal": [0.0, 0.0, 1.0]}}
        hole = {"box": {"min": [0.4, 0.3, -1.0], "max": [0.6, 0.5, 2.0]}}
        far = {"box": {"min": [1.2, 0.2, 0.0], "max": [1.4, 0.6, 0.5]}}
        pi = math.pi
        for shape, wanted in (
            (box, 0.12),
            (ball, 4 / 3 * pi * 0.027),
            (rod, pi * 0.01),
            (plane, 0.5),
            ({"union": [box, far]}, 0.16),
            ({"difference": [box, hole]}, 0.1),
        ):
            with self.subTest(list(shape)[0]):
                (thing,) = solids.add_solids(scene(solid=[solid(shape)]), stage._matt)
                measured, closed = volume(thing)
                self.assertTrue(closed)
                self.assertAlmostEqual(measured, wanted, delta=0.004 * wanted)
                bpy.data.objects.remove(thing)

    def test_what_lies_outside_of_the_domain_is_cut_off_where_it_ends(self):
        ball = {"sphere": {"center": [0.0, 0.5, 0.5], "radius": 0.3}}
        half = 2 / 3 * math.pi * 0.027
        for side, wanted in (("wall", half), ("unbounded", 2 * half)):
            own = scene(solid=[solid(ball)])
            own["domain"]["sides"]["x_low"] = side
            (thing,) = solids.add_solids(own, stage._matt)
            measured, closed = volume(thing)
            self.assertTrue(closed)
            self.assertAlmostEqual(measured, wanted, delta=0.004 * wanted)

    def test_meshes_lie_where_the_scene_puts_them(self):
        file = os.path.join(self.folder, "part")
        corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        with open(file + ".obj", "w") as out:
            out.write(
                "".join(f"v {x} {y} {z}\n" for x, y, z in corners)
                + "".join("f %d %d %d\n" % tuple(k + 1 for k in face) for face in faces)
            )
        with open(file + ".stl", "w") as out:
            out.write("solid a\n")
            for face in faces:
                out.write(
                    "facet normal 0 0 0\nouter loop\n"
                    + "".join("vertex %g %g %g\n" % corners[k] for k in face)
                    + "endloop\nendfacet\n"
                )
            out.write("endsolid a\n")
        with open(file + ".ply", "w") as out:
            out.write(
                "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                "element face 4\n"
                "property list uchar int vertex_indices\nend_header\n"
                + "".join("%g %g %g\n" % c for c in corners)
                + "".join("3 %d %d %d\n" % face for face in faces)
            )
        for ending in ("obj", "stl", "ply"):
            mesh = {
                "mesh": {
                    "file": f"{file}.{ending}",
                    "up": "y",
                    "rotate": [0, 0, 90],
                    "scale": 0.5,
                    "translate": [1.0, 0.25, 0.25],
                }
            }
            (thing,) = solids.add_solids(scene(solid=[solid(mesh)]), stage._matt)
            # y up: (x, y, z) is (x, -z, y); turned about z: (z, x, y).
            wanted = sorted((1.0 + 0.5 * z, 0.25 + 0.5 * x, 0.25 + 0.5 * y) for x, y, z in corners)
            found = sorted(tuple(round(v, 6) for v in vertex.co) for vertex in thing.data.vertices)
            np.testing.assert_allclose(found, wanted, atol=1e-5)
            self.assertEqual([other.name for other in bpy.data.objects], [thing.name])
            bpy.data.objects.remove(thing)

    def test_ground_has_the_heights_of_its_picture(self):
        image = bpy.data.images.new("bed", 4, 2, is_data=True)
        grey = np.ones((2, 4, 4), np.float32)
        grey[..., :3] = np.arange(8).reshape(2, 4, 1) * 32 / 255
        image.pixels.foreach_set(grey.ravel())
        image.filepath_raw, image.file_format = os.path.join(self.folder, "bed.png"), "PNG"
        image.save()
        bpy.data.images.remove(image)
        field = {
            "height_field": {
                "file": os.path.join(self.folder, "bed.png"),
                "pixel": 0.5,
                "low": 0.0,
                "high": 1.0,
                "translate": [0.0, 0.0, 0.1],
            }
        }
        (thing,) = solids.add_solids(scene(solid=[solid(field)]), stage._matt)
        self.assertTrue(volume(thing)[1])
        hit, place, *_ = thing.ray_cast(Vector((0.75, 0.75, 5)), Vector((0, 0, -1)))
        self.assertTrue(hit)
        self.assertAlmostEqual(place.z, 0.1 + 5 * 32 / 255, 3)

    def test_solids_move_come_and_go_as_the_scene_says(self):
        box = {"box": {"min": [0.0, 0.0, 0.0], "max": [0.2, 0.2, 0.2]}}
        keys = [
            {"time": 0.05, "move": [0, 0, 0], "turn": 0.0},
            {"time": 0.15, "move": [0.4, 0, 0], "turn": 180.0},
        ]
        (thing,) = solids.add_solids(
            scene(solid=[solid(box, keyframe=keys, pivot=[0.1, 0.1, 0], until=0.2)]), stage._matt
        )
        current = bpy.context.scene
        for frame, move, degrees, hidden in (
            (1, 0, 0, False),
            (2, 0, 0, False),
            (3, 0.2, 90, False),
            (4, 0.4, 180, False),
            (5, 0.4, 180, True),
        ):
            current.frame_set(frame)
            corner = thing.matrix_world @ Vector((0.2, 0.2, 0))
            turn = math.radians(degrees)
            c, s = math.cos(turn), math.sin(turn)
            np.testing.assert_allclose(
                corner, (0.1 + 0.1 * (c - s) + move, 0.1 + 0.1 * (c + s), 0), atol=1e-5
            )
            self.assertEqual(thing.hide_render, hidden)
        self.assertEqual(len(solids.add_solids(scene(solid=[solid(box, visible=False)]), stage._matt)), 0)

    def test_a_sequence_changes_its_shape_evenly(self):
        for number in (3, 4, 5):
            with open(os.path.join(self.folder, f"s{number:04d}.obj"), "w") as out:
                out.write(
                    f"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 {0.1 * (number - 2) ** 2:g}\n"
                    "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
                )
        sequence = {
            "mesh_sequence": {
                "files": os.path.join(self.folder, "s%04d.obj"),
                "first": 3,
                "last": 5,
                "frame_rate": 10.0,
                "start": 0.0,
                "up": "z",
                "rotate": [0, 0, 0],
                "scale": 1.0,
                "translate": [0, 0, 0],
            }
        }
        (thing,) = solids.add_solids(scene(solid=[solid(sequence)]), stage._matt)
        for frame, height in ((1, 0.1), (2, 0.25), (3, 0.4), (4, 0.65), (5, 0.9)):
            bpy.context.scene.frame_set(frame)
            mesh = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
            self.assertAlmostEqual(max(vertex.co.z for vertex in mesh.vertices), height, 4)


class Pictures(InBlender):
    def make_run(self):
        folder, squares = self.run_folder(sides=(70, 64, 60))
        own = scene(frames=3, solid=[solid({"sphere": {"center": [1.5, 0.5, 0.3], "radius": 0.25}})])
        own["texture"]["exemplar"] = os.path.join(folder, "noise.png")
        own["render"].update(ground=True, tank=True, exposure=1.25)
        with open(os.path.join(folder, "run.json"), "w") as report:
            json.dump({"scene": own, "frames": []}, report)
        return folder

    def asked(self, folder, **more):
        """What the program would ask for."""
        with open(os.path.join(folder, "run.json")) as report:
            own = json.load(report)["scene"]
        return {
            "run": folder,
            "scene": own,
            "origin": [0.0, 0.0, 0.0],
            "frames": [1, 2, 3],
            "pictures": self.folder,
            "shutter": 0.0,
            "shader": "coat",
            "maps": {},
            "height": None,
            "blend": None,
            **more,
        }

    def light(self, frame):
        return np.fromfile(os.path.join(self.folder, f"{frame:04d}.light"), "<f4").reshape(48, 64, 3)

    def test_every_frame_becomes_a_picture_of_the_scene_that_is_asked_for(self):
        folder = self.make_run()
        asked = self.asked(folder, frames=[2, 3], shutter=0.5)
        asked["scene"]["render"].update(samples=4, ground=False)
        cycles.draw(asked)
        self.assertEqual(sorted(os.listdir(self.folder)), ["0002.light", "0003.light", "light.exr", "run"])
        picture = self.light(3)
        self.assertGreater(np.abs(picture - self.light(2)).mean(), 0.001)
        # Rows from the top: below the horizon there is no ground, which the run has.
        np.testing.assert_allclose(picture[-1, 0], (0.8, 0.7, 0.6), atol=0.01)
        asked = self.asked(folder, frames=[3])
        asked["scene"]["render"]["ground_color"] = [0.1, 0.1, 0.1]
        cycles.draw(asked)
        self.assertLess(self.light(3)[-1, 0].max(), 0.4)

    def test_coat_and_relief_are_those_of_the_scene_that_is_asked_for(self):
        folder = self.make_run()
        asked = self.asked(folder)
        asked["scene"]["render"].update(gloss=0.25, roughness=0.16, bump={"map": "height", "height": 2.0})
        noise = os.path.join(folder, "noise.png")
        asked["scene"]["texture"]["map"] = [{"name": "height", "file": noise}]
        cycles.set_up(asked)
        own = bpy.data.objects["small"].fluidtex
        self.assertEqual(own.bump_map, noise)
        nodes = bpy.data.objects["small"].data.materials[0].node_tree.nodes
        film = next(node for node in nodes if node.type == "BSDF_GLOSSY")
        self.assertAlmostEqual(film.inputs["Roughness"].default_value, 0.4, 6)
        asked = self.asked(folder, maps={"bump": noise, "color": noise}, height=0.125)
        cycles.set_up(asked)
        own = bpy.data.objects["small"].fluidtex
        self.assertEqual((own.bump_map, own.color_map), (noise, noise))
        self.assertEqual(own.bump_distance, 0.125)

    def test_the_finer_picture_is_that_of_the_scene_or_the_runs_own_copy_of_it(self):
        folder = self.make_run()
        copy = os.path.join(folder, "between.png")
        shutil.copy(os.path.join(folder, "noise.png"), copy)
        asked = self.asked(folder)
        run = fluidtex.Run(folder)
        self.assertEqual(cycles.maps_of(asked, run), {})
        asked["scene"]["texture"].update(between="file", between_file="/pictures/fine.png")
        self.assertEqual(cycles.maps_of(asked, run), {"color": "/pictures/fine.png"})
        run.scene["texture"].update(between="file", between_file="/pictures/fine.png")
        run.between = copy
        self.assertEqual(cycles.maps_of(asked, run), {"color": copy})
        asked["maps"] = {"color": "/mine.png"}
        self.assertEqual(cycles.maps_of(asked, run), {"color": "/mine.png"})

    def test_the_scene_can_be_saved_instead(self):
        folder = self.make_run()
        file = os.path.join(folder, "scene.blend")
        cycles.draw(self.asked(folder, blend=file))
        self.assertEqual(os.listdir(self.folder), ["run"])
        bpy.ops.wm.open_mainfile(filepath=file)
        names = {thing.name for thing in bpy.data.objects}
        self.assertEqual(names, {"camera", "sun", "ground", "tank", "solid 0", "small"})
        bpy.context.scene.frame_set(2)
        self.assertEqual(len(bpy.data.objects["small"].data.vertices), 64 * 64)

    def test_faults_are_told(self):
        folder = self.make_run()
        for more, sentence in (
            ({"run": self.folder}, "holds no surface"),
            ({"maps": {"bump": "/nothing.png"}}, "is no picture"),
        ):
            with self.assertRaisesRegex(fluidtex.Problem, sentence):
                cycles.draw(self.asked(folder, **more))


if __name__ == "__main__":
    run_tests(sys.modules["__main__"])
