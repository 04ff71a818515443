"""`fluidtex render --cycles` as a user calls it.

    render.tests.py FLUIDTEX      exits with 77 where Blender is not installed
"""
import os
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCENE = os.path.join(ROOT, "tests", "tools", "small.toml")
PROGRAM = None
SMALL = ["--set", "render.size=[64, 48]", "--set", "render.samples=2"]


def processes_in(folder):
    """Whose command line or environment names the folder."""
    found = []
    for number in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{number}/environ", "rb") as file:
                if folder.encode() in file.read():
                    found.append(number)
        except OSError:
            pass
    return found


class Render(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="fluid tex ü%&")
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        os.environ["XDG_CACHE_HOME"] = os.path.join(cls.folder, "cache")
        cls.run_folder = os.path.join(cls.folder, "run")
        subprocess.run(
            [PROGRAM, "run", SCENE, "--set", "frames=3", "--set", "texture.points=1500", *SMALL, "--quiet"]
            + ["--out", cls.run_folder],
            check=True,
        )

    def setUp(self):
        self.out = tempfile.mkdtemp(dir=self.folder)

    def command(self, *words):
        return [PROGRAM, "render", SCENE, "--set", "frames=3", *SMALL, "--from", self.run_folder] + [
            "--out",
            self.out,
            "--cycles",
            *words,
        ]

    def render(self, *words, code=0):
        done = subprocess.run(self.command(*words), capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def picture(self, frame, folder=None):
        with open(os.path.join(folder or self.out, "frames", f"{frame:04d}.png"), "rb") as file:
            return file.read()

    def names(self, *parts):
        return sorted(os.listdir(os.path.join(self.out, *parts)))

    def test_pictures_video_and_page_lie_where_render_puts_them(self):
        said = self.render("--shutter", "0.5")
        self.assertEqual(self.names(), ["frames", "report.html", "small.mp4"])
        self.assertEqual(self.names("frames"), ["0001.png", "0002.png", "0003.png"])
        self.assertEqual(re.findall(r"^frame (\d)/3", said, re.MULTILINE), ["1", "2", "3"])
        picture = self.picture(2)
        self.assertEqual(struct.unpack(">II", picture[16:24]), (64, 48))
        self.assertIn(b"Frame\x002", picture)
        self.assertNotEqual(picture, self.picture(2, self.run_folder))

    def test_parts_and_missing_ones_give_the_same_bytes(self):
        whole, self.out = self.out, tempfile.mkdtemp(dir=self.folder)
        subprocess.run(
            [word if word != self.out else whole for word in self.command("--threads", "1")], check=True
        )
        self.render("--part", "--frames", "1:2", "--threads", "2", "--no-report")
        self.assertEqual(self.names(), ["frames"])
        before = os.stat(os.path.join(self.out, "frames", "0001.png"))
        os.remove(os.path.join(self.out, "frames", "0002.png"))
        self.render("--missing", "--no-report")
        self.assertEqual(self.names(), ["frames", "small.mp4"])
        after = os.stat(os.path.join(self.out, "frames", "0001.png"))
        self.assertEqual((before.st_ino, before.st_mtime_ns), (after.st_ino, after.st_mtime_ns))
        for frame in (1, 2, 3):
            self.assertEqual(self.picture(frame), self.picture(frame, whole))

    def test_the_scene_decides_and_maps_count(self):
        self.render("--part", "--frames", "2")
        plain = self.picture(2)
        for words in (
            ["--set", "camera.fov=20"],
            ["--set", "render.exposure=2"],
            ["--shader", "principled"],
            ["--map", "alpha=" + os.path.join(ROOT, "scenes", "exemplars", "foam.png")],
        ):
            self.render("--part", "--frames", "2", *words)
            self.assertNotEqual(self.picture(2), plain, words)

    def test_a_signal_ends_it_at_once_and_leaves_nothing_unfinished(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            work = subprocess.Popen(
                self.command("--set", "render.samples=20000"), stderr=subprocess.PIPE, text=True
            )
            end = time.monotonic() + 60
            while len(processes_in(self.out)) < 1 and time.monotonic() < end:
                time.sleep(0.05)
            time.sleep(1)
            work.send_signal(number)
            began = time.monotonic()
            said = work.communicate(timeout=60)[1]
            self.assertLess(time.monotonic() - began, 5)
            self.assertEqual(work.returncode, 130, said)
            self.assertIn("--missing goes on", said)
            self.assertEqual(processes_in(self.out), [])
            self.assertEqual(self.names("frames"), [])

    def test_a_killed_one_leaves_nothing_that_stays(self):
        work = subprocess.Popen(self.command("--set", "render.samples=20000"), stderr=subprocess.PIPE)
        end = time.monotonic() + 60
        while not processes_in(self.out) and time.monotonic() < end:
            time.sleep(0.05)
        work.kill()
        work.wait()
        work.stderr.close()
        end = time.monotonic() + 10
        while processes_in(self.out) and time.monotonic() < end:
            time.sleep(0.05)
        self.assertEqual(processes_in(self.out), [])
        self.assertEqual([name[:5] for name in self.names("frames")], [".tmp-"])
        self.render("--part", "--frames", "1")
        self.assertEqual(self.names("frames"), ["0001.png"])

    def test_the_scene_can_be_saved_for_blender(self):
        self.render("--blend", os.path.join(self.out, "all.blend"))
        self.assertEqual(self.names(), ["all.blend"])

    def test_what_is_wrong_is_one_sentence(self):
        for words, sentence in (
            (["--map", "bark=bark.png"], "color, roughness, normal, bump, displacement, alpha"),
            (["--map", "bump=/nothing.png"], "there is no such picture"),
            (["--map", "bump=" + SCENE], "is no picture"),
            (["--map", "bump"], "KIND=IMAGE"),
            (["--frames", "2:9"], "has 3 frames"),
        ):
            said = self.render(*words, code=1)
            self.assertIn(sentence, said)
            self.assertEqual(len(said.strip().splitlines()), 1, said)
        for words in (
            ["--shutter", "0.5"],
            ["--shader", "coat"],
            ["--map", "bump=a.png"],
            ["--blend", "a.blend"],
        ):
            command = [word for word in self.command(*words) if word != "--cycles"]
            done = subprocess.run(command, capture_output=True, text=True)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(f"{words[0]} requires --cycles", done.stderr)

    def test_without_blender_a_sentence_says_so(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("env", "ffmpeg"):
                os.symlink(shutil.which(name), os.path.join(folder, name))
            done = subprocess.run(
                self.command(), capture_output=True, text=True, env={**os.environ, "PATH": folder}
            )
        self.assertEqual(done.returncode, 2)
        self.assertEqual(
            done.stderr,
            "error: --cycles: blender is not installed: apt-get install --no-install-recommends blender\n",
        )
        self.assertEqual(self.names("frames"), [])


if __name__ == "__main__":
    if not shutil.which("blender"):
        print("blender is not installed: apt-get install --no-install-recommends blender")
        sys.exit(77)
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
