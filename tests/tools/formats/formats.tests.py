"""Every format that surfaces are written as, read back by programs of others and compared with the PLY of the frame.

    formats.tests.py FLUIDTEX blender|paraview|node|openusd      exits with 77 where the reader is not installed

Each reader (in_blender.py, in_paraview.py, in_node.mjs, in_openusd.mjs) prints as JSON what it found; what is true stands here.
"""
import json
import math
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
SCENE = os.path.join(HERE, "..", "small.toml")
FLUIDTEX = READER = None
FIRST, LAST, RATE = 4, 5, 24.0


def read_ply(path):
    """Columns of the vertices by name, the triangles, and which of these are joints."""
    with open(path, "rb") as file:
        data = file.read()
    head, _, body = data.partition(b"end_header\n")
    counts, names, kinds = {}, [], "<"
    for line in head.decode().splitlines():
        words = line.split()
        if words[0] == "element":
            counts[words[1]] = int(words[2])
            inside = words[1]
        elif words[0] == "property" and inside == "vertex":
            names.append(words[2])
            kinds += {"float": "f", "uchar": "B"}[words[1]]
    size, n = struct.calcsize(kinds), counts["vertex"]
    columns = list(zip(*struct.iter_unpack(kinds, body[: n * size])))
    at = n * size
    faces = [face[1:] for face in struct.iter_unpack("<B3i", body[at : at + 13 * counts["face"]])]
    at += 13 * counts["face"]
    joints = {struct.unpack_from("<i", body, at + 148 * i)[0] for i in range(counts.get("joint", 0))}
    return dict(zip(names, columns)), faces, joints


def area(points, triangles):
    total = 0.0
    for a, b, c in triangles:
        u = [points[b][k] - points[a][k] for k in range(3)]
        v = [points[c][k] - points[a][k] for k in range(3)]
        cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        total += 0.5 * math.sqrt(sum(x * x for x in cross))
    return total


def linear(c):
    """Of the value in a picture, sRGB."""
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4


class Formats(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.mkdtemp(prefix="fluidtex formats & ü ")
        cls.runs = {}
        for joints in ("cut", "blend"):
            made = os.path.join(cls.scratch, "made here " + joints)
            subprocess.run(
                [FLUIDTEX, "run", SCENE, "--out", made, "--frames", f"{FIRST}:{LAST}", "--no-render", "--quiet",
                 "--format", "glb,obj", "--format", "usda,vtp", "--joints", joints], check=True)  # fmt: skip
            # All of it can be moved.
            cls.runs[joints] = os.path.join(cls.scratch, "moved " + joints)
            os.rename(made, cls.runs[joints])
        cls.vertices, cls.faces, cls.joints = read_ply(os.path.join(cls.runs["cut"], "surface", f"{LAST:04}.ply"))
        v = cls.vertices
        cls.points = list(zip(v["x"], v["y"], v["z"]))
        cls.count = len(cls.points)
        cls.area = area(cls.points, cls.faces)
        cls.low = [min(p[k] for p in cls.points) for k in range(3)]
        cls.high = [max(p[k] for p in cls.points) for k in range(3)]

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.scratch)

    def file(self, joints, *names):
        return os.path.join(self.runs[joints], *names)

    def found(self, *command):
        """What a reader prints behind the line 'FOUND'."""
        # Debian's Blender and ParaView take the Python that comes first, which has to be Debian's.
        path = os.pathsep.join(["/usr/bin", os.environ["PATH"]])
        done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "PATH": path})
        if done.returncode == 77:
            self.skipTest(done.stderr.strip())
        self.assertIn("FOUND\n", done.stdout, done.stdout[-3000:] + done.stderr[-3000:])
        return json.loads(done.stdout.split("FOUND\n")[1].splitlines()[0])

    def close(self, ours, theirs, delta=1e-5):
        self.assertEqual(len(ours), len(theirs))
        for a, b in zip(ours, theirs):
            self.assertAlmostEqual(a, b, delta=delta)

    def is_the_surface(self, found, delta=1e-5):
        """Bounds, Z up, and area: cut or not, it is the same set of points."""
        self.close(self.low, found["low"], delta)
        self.close(self.high, found["high"], delta)
        self.assertAlmostEqual(found["area"] / self.area, 1.0, delta=1e-4)

    def shows_its_colors(self, found):
        """The picture at the vertices' texture coordinates is what the vertices' colours were looked up at."""
        still = [i for i in range(self.count) if self.vertices["fade"][i] == 0.0]
        self.assertGreater(len(still), self.count // 5)
        error = sum(
            abs(self.vertices[name][i] / 255.0 - found["looked up"][i][k])
            for i in still
            for k, name in enumerate(("red", "green", "blue"))
        )
        self.assertLess(error / (3 * len(still)), 0.01)


@unittest.skipUnless(shutil.which("blender"), "blender is not installed")
class InBlender(Formats):
    def read(self, file):
        return self.found("blender", "-b", "--factory-startup", "-P", os.path.join(HERE, "in_blender.py"), "--", file)

    def is_the_surface_with_its_picture(self, found, uv_sets):
        self.is_the_surface(found)
        self.assertEqual(found["uv sets"], uv_sets)
        self.assertEqual(found["picture"], [256, 256])
        self.shows_its_colors(found)

    def has_colors(self, found, name):
        """At the vertices, linear as Blender holds them."""
        ours = [linear(c / 255.0) for c in self.vertices[name]]
        self.close(ours, found["colors"][0][name][: self.count], 0.01)

    def test_glb(self):
        self.is_the_surface_with_its_picture(self.read(self.file("cut", "glb", f"{LAST:04}.glb")), 2)

    def test_glb_with_joints_that_blend(self):
        found = self.read(self.file("blend", "glb", f"{LAST:04}.glb"))
        self.is_the_surface(found)
        self.assertEqual(found["uv sets"], 6)
        self.assertEqual(found["triangles"], len(self.faces))
        self.assertEqual(len(found["colors"]), 1)
        self.has_colors(found, "green")

    def test_obj(self):
        found = self.read(self.file("cut", "obj", f"{LAST:04}.obj"))
        self.is_the_surface_with_its_picture(found, 1)
        self.has_colors(found, "red")


@unittest.skipUnless(shutil.which("pvpython"), "ParaView's pvpython is not installed (python3-paraview)")
class InParaView(Formats):
    def test_vtp_and_pvd(self):
        found = self.found("pvpython", os.path.join(HERE, "in_paraview.py"), self.file("cut", "small.pvd"))
        self.close([(frame - 1) / RATE for frame in range(FIRST, LAST + 1)], found["times"], 1e-12)
        self.is_the_surface(found)
        arrays = found["arrays"]
        for name in ("age", "trust", "contact", "fade"):
            self.close(self.vertices[name], arrays[name][: self.count], 1e-6)
        for name, parts in (("velocity", "vx vy vz"), ("orientation", "dx dy dz"), ("previous_position", "bx by bz"),
                            ("normal", "nx ny nz"), ("gradient_s", "sx sy sz")):  # fmt: skip
            for k, part in enumerate(parts.split()):
                self.close(self.vertices[part], [row[k] for row in arrays[name][: self.count]], 1e-5)
        self.close(self.vertices["green"], [row[1] for row in arrays["color"][: self.count]], 1.01)
        # The origin is the lower left corner; a toroidal exemplar goes on beyond it.
        for i in range(self.count):
            for k, (ours, theirs) in enumerate(((self.vertices["s"][i], arrays["st"][i][0]),
                                                (1.0 - self.vertices["t"][i], arrays["st"][i][1]))):  # fmt: skip
                self.assertAlmostEqual((ours - theirs + 0.5) % 1.0, 0.5, delta=1e-5)


@unittest.skipUnless(shutil.which("node") and shutil.which("npm"), "node and npm are not installed")
class InNode(Formats):
    def read(self, file):
        return self.found("node", os.path.join(HERE, "in_node.mjs"), file)

    def test_glb(self):
        found = self.read(self.file("cut", "glb", f"{LAST:04}.glb"))
        self.assertEqual(found["errors"], 0)
        self.assertEqual(found["warnings"], 0)
        # The node turns Z to Y.
        self.close([self.low[0], self.low[2], -self.high[1]], found["low"])
        self.close([self.high[0], self.high[2], -self.low[1]], found["high"])
        for name, attribute in (("age", "_AGE"), ("trust", "_TRUST"), ("contact", "_CONTACT"), ("s", None)):
            if attribute:
                self.close(self.vertices[name], found["attributes"][attribute][: self.count], 1e-6)
        self.close(self.vertices["vz"], found["attributes"]["_VELOCITY"][2 : 3 * self.count : 3], 1e-6)
        self.assertEqual(found["picture"], [256, 256])

    def test_glb_with_joints_that_blend(self):
        found = self.read(self.file("blend", "glb", f"{LAST:04}.glb"))
        self.assertEqual(found["errors"], 0)
        joint, index = found["attributes"]["_JOINT"], found["indices"]
        sets = [found["attributes"][f"TEXCOORD_{n}"] for n in range(3)]
        self.assertEqual(len(index), 3 * len(self.faces))
        for t, face in enumerate(self.faces):
            for c, vertex in enumerate(face):
                at = index[3 * t + c]
                if t in self.joints:
                    self.assertEqual(joint[3 * at : 3 * at + 3], [float(k == c) for k in range(3)])
                for label in range(3):
                    # Of the corner's own piece it is the corner's own place; elsewhere all three are that.
                    if t not in self.joints or label == c:
                        for k, ours in enumerate((self.vertices["s"][vertex], self.vertices["t"][vertex])):
                            off = sets[label][2 * at + k] - ours
                            self.assertAlmostEqual((off + 0.5) % 1.0, 0.5, delta=1e-5)

    def test_usda(self):
        for joints in ("cut", "blend"):
            with self.subTest(joints):
                found = self.read(self.file(joints, "usd", f"{LAST:04}.usda"))
                self.is_the_surface(found)
                if joints == "cut":
                    for i in range(self.count):
                        self.assertAlmostEqual((found["st"][2 * i] - self.vertices["s"][i] + 0.5) % 1.0, 0.5, delta=1e-5)
                    self.assertEqual(found["picture"], "../exemplar.png")

    def test_usd_stage(self):
        found = self.read(self.file("cut", "small.usda"))
        for frame in range(FIRST, LAST + 1):
            self.assertIn(f"./usd/{frame:04}.usda", found["layer"])
        self.assertEqual(found["references"], [f"./usd/{found['references'][0][6:10]}.usda"])


@unittest.skipUnless(shutil.which("node") and shutil.which("npm") and shutil.which("chromium"),
                     "node, npm and chromium are not installed")  # fmt: skip
class InOpenUsd(Formats):
    def test_stage(self):
        for joints in ("cut", "blend"):
            with self.subTest(joints):
                stage = self.file(joints, "small.usda")
                found = self.found("node", os.path.join(HERE, "in_openusd.mjs"), stage, str(FIRST), str(LAST))
                self.assertNotIn("error", found)
                self.assertEqual([found["start"], found["end"], found["rate"]], [FIRST, LAST, RATE])
                for frame in range(FIRST, LAST + 1):
                    mesh = found["frames"][str(frame)]
                    vertices, faces, _ = read_ply(self.file(joints, "surface", f"{frame:04}.ply"))
                    count = len(vertices["x"])
                    # Its own vertices, joints cut or not, at every frame.
                    for k, name in enumerate("xyz"):
                        self.close(vertices[name], mesh["points"][k : 3 * count : 3], 1e-6)
                    points = list(zip(*(mesh["points"][k::3] for k in range(3))))
                    triangles = list(zip(*(mesh["indices"][k::3] for k in range(3))))
                    whole = area(list(zip(vertices["x"], vertices["y"], vertices["z"])), faces)
                    self.assertAlmostEqual(area(points, triangles) / whole, 1.0, delta=1e-4)
                    self.assertEqual(mesh["primvars"]["st"], {"rows": len(mesh["indices"]), "interpolation": "facevarying"})
                    self.assertEqual(mesh["primvars"]["velocities"]["rows"], len(points))
                    self.assertEqual(mesh["primvars"]["displayColor"], {"rows": len(points), "interpolation": "vertex"})
                    if joints == "cut":
                        self.assertEqual(mesh.get("material", "/liquid/material"), "/liquid/material")
                    else:
                        self.assertEqual(mesh["primvars"]["joint"]["rows"], len(mesh["indices"]))


if __name__ == "__main__":
    FLUIDTEX, READER = sys.argv[1], sys.argv[2]
    tests = {"blender": InBlender, "paraview": InParaView, "node": InNode, "openusd": InOpenUsd}[READER]
    result = unittest.TextTestRunner(verbosity=2).run(unittest.defaultTestLoader.loadTestsFromTestCase(tests))
    if result.skipped and result.testsRun == len(result.skipped) or result.testsRun == 0:
        sys.exit(77)
    sys.exit(not result.wasSuccessful())
