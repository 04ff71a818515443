"""tools/farm on a real Slurm, started here and ended again: farm.tests.py FLUIDTEX.

Exits with 77 where Slurm is not installed.
"""
import filecmp
import glob
import itertools
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True
import cluster

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FARM = os.path.join(ROOT, "tools", "farm")
SCENE = os.path.join(ROOT, "tests", "tools", "small.toml")
PICTURES = [os.path.join(ROOT, "scenes", "exemplars", name) for name in ("green_scales.png", "lava.png")]
PROGRAM = ""  # set below
# So slow that there is time to take something away, and so quick that nobody waits.
SLOW = [
    "--set",
    "frames=4",
    "--set",
    "texture.points=9000",
    "--set",
    "render.samples=64",
    "--set",
    "render.size=[320, 180]",
]
SHORT = ["--set", "frames=2", "--set", "texture.points=1500"]


def text_of(file):
    with open(file, encoding="utf-8", errors="replace") as opened:
        return opened.read()


def contents(folder, *parts):
    """Bytes by name."""
    files = [file for part in parts for file in glob.glob(os.path.join(glob.escape(folder), part, "*"))]
    return {os.path.relpath(file, folder): pathlib.Path(file).read_bytes() for file in files}


class Farm(unittest.TestCase):
    def assert_same(self, folder, expected, count):
        """That the folder holds these bytes, of so many files."""
        self.assertEqual(len(expected), count)
        found = contents(folder, *{os.path.dirname(name) for name in expected})
        self.assertEqual(sorted(found), sorted(expected))
        self.assertEqual([name for name in expected if found[name] != expected[name]], [], folder)

    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="farm")
        cls.addClassCleanup(cls.scratch.cleanup)
        folder = os.path.join(cls.scratch.name, "slurm")
        os.makedirs(folder)
        os.environ["XDG_CACHE_HOME"] = os.path.join(cls.scratch.name, "cache")
        cls.slurm = cluster.Cluster(folder)
        cls.slurm.__enter__()
        cls.addClassCleanup(cls.slurm.__exit__)
        cls.environment = cls.slurm.environment

    def out(self, name):
        return os.path.join(self.scratch.name, name)

    def farm(self, *words, code=0):
        """What it prints."""
        done = subprocess.run(
            [FARM, "--program", PROGRAM, *words], env=self.environment, capture_output=True, text=True
        )
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def plain_run(self, out, *words):
        subprocess.run(
            [PROGRAM, "run", SCENE, "--quiet", "--out", out, *words], check=True, env=self.environment
        )

    def wait(self, is_so, what, seconds=300):
        end = time.monotonic() + seconds
        while not is_so():
            if time.monotonic() > end:
                self.fail(f"{what}\n{self.slurm.ask('squeue')}{self.words()}")
            self.slurm.hasten()
            time.sleep(0.02)

    def words(self):
        """Of all jobs."""
        files = glob.glob(os.path.join(self.scratch.name, "**", "jobs", "*.log"), recursive=True)
        return "".join(f"== {file}\n{text_of(file)}" for file in files)

    def wait_for_end(self):
        self.wait(lambda: not self.slurm.ask("squeue", "--noheader"), "the jobs do not end")

    def jobs(self, out):
        """Their numbers, by name."""
        return json.loads(text_of(os.path.join(out, "jobs", "farm.json")))["jobs"]

    def starts(self, out, log):
        return text_of(os.path.join(out, "jobs", log)).count("--- ")

    def test_the_bytes_of_one_machine_though_one_is_lost_and_a_program_is_killed(self):
        plain, out = self.out("plain"), self.out("farm")
        self.plain_run(plain, *SLOW)
        self.farm(SCENE, *SLOW, "--link", "3", "--chunk", "2", "--out", out)
        run = os.path.join(out, "small")
        there = lambda *parts: os.path.exists(os.path.join(run, *parts))

        # The machine of the chain's first job is lost when a frame is done.
        self.wait(lambda: there("state", "0001") or there("state", "0002"), "no frame is textured")
        self.assertFalse(there("surface", "0003.ply"), "too quick to be interrupted")
        job = self.jobs(out)["small/texture-1"]
        self.slurm.lose(self.slurm.ask("squeue", "--noheader", "--format=%N", f"--jobs={job}").strip(), job)
        # The program that draws the array's first frames is killed after the first of them.
        self.wait(lambda: there("frames", "0001.png"), "nothing is drawn")
        drawing = [
            number
            for number, words in cluster.processes()
            if {"render", run, "1:2"} <= {*words} and "bash" not in words[0]
        ]
        self.assertEqual(len(drawing), 1, "too quick to be killed")
        os.kill(drawing[0], signal.SIGKILL)
        self.assertFalse(there("frames", "0002.png"), "too quick to be killed")
        before = os.stat(os.path.join(run, "frames", "0001.png"))
        self.wait_for_end()

        self.assertIn("done", self.farm("--status", out), self.words())
        self.assertEqual(self.starts(out, "small-texture-1.log"), 2, self.words())
        self.assertEqual(self.starts(out, "small-draw.0.log"), 2, self.words())
        self.assertEqual(self.starts(out, "small-draw.1.log"), 1, self.words())
        # What was done before was not done again.
        begun = re.findall(r"frames (\d) to (\d)", text_of(os.path.join(run, "log.txt")))
        self.assertEqual([last for _, last in begun], ["3", "3", "4"])
        self.assertEqual(begun[0][0], "1")
        self.assertIn(begun[1][0], "23")
        self.assertEqual(begun[2][0], "4")
        after = os.stat(os.path.join(run, "frames", "0001.png"))
        self.assertEqual((before.st_ino, before.st_mtime_ns), (after.st_ino, after.st_mtime_ns))
        self.assert_same(run, contents(plain, "frames", "surface"), 8)
        self.assertTrue(
            filecmp.cmp(os.path.join(run, "small.mp4"), os.path.join(plain, "small.mp4"), shallow=False)
        )
        self.assertTrue(there("report.html"))

    def test_a_wedge_simulates_once_and_ends_in_a_contact_sheet(self):
        out = self.out("fünf & 5 % 'x'")
        shown = self.farm(
            SCENE,
            *SHORT,
            "--wedge",
            "exemplar=" + ",".join(PICTURES),
            "--wedge",
            "render.exposure=1,2",
            "--chunk",
            "1",
            "--out",
            out,
        )
        self.assertIn(
            "14 jobs", shown
        )  # one simulates; of each variant one textures, one draws, one finishes; the sheet
        self.assertIn("still in the queue", self.farm(SCENE, *SHORT, "--resume", "--out", out, code=1))
        self.wait_for_end()
        self.assertTrue(os.path.exists(os.path.join(out, "sheet.jpg")), self.words())
        self.assertEqual(self.farm("--status", out).count("done"), 4)
        for picture, exposure in itertools.product(PICTURES, "12"):
            name = f"exemplar-{os.path.basename(picture).removesuffix('.png')}-exposure-{exposure}"
            plain = self.out(name)
            self.plain_run(plain, *SHORT, "--exemplar", picture, "--set", f"render.exposure={exposure}")
            self.assert_same(os.path.join(out, "small", name), contents(plain, "frames", "surface"), 4)

    @unittest.skipUnless(shutil.which("blender"), "blender is not installed")
    def test_cycles_draws_the_same_pictures_in_jobs(self):
        out, plain = self.out("cycles"), self.out("plain_cycles")
        given = [*SHORT, "--set", "render.samples=2"]
        self.farm(SCENE, *given, "--cycles", "--chunk", "1", "--out", out)
        self.plain_run(plain, *given, "--no-render")
        subprocess.run(
            [PROGRAM, "render", SCENE, *given, "--from", plain, "--out", plain, "--cycles", "--quiet"],
            check=True,
        )
        self.wait_for_end()
        self.assertIn("drawn 2; done", self.farm("--status", out), self.words())
        self.assert_same(os.path.join(out, "small"), contents(plain, "frames"), 2)
        self.assertTrue(os.path.exists(os.path.join(out, "small", "small.mp4")))

    def test_what_waits_for_a_failed_job_is_cancelled_and_resume_goes_on(self):
        out, picture = self.out("failing"), self.out("my picture.png")
        shutil.copy(PICTURES[0], picture)
        given = [SCENE, *SHORT, "--exemplar", picture, "--out", out]
        self.farm(*given, "--sbatch=--hold")
        os.rename(picture, picture + "x")
        self.slurm.ask("scontrol", "release", *self.jobs(out).values())
        self.wait_for_end()
        self.assertIn("stopped", self.farm("--status", out))
        self.assertIn("my picture.png", self.words())
        os.rename(picture + "x", picture)
        self.assertIn("is there already", self.farm(*given, code=1))
        self.farm(*given, "--resume")
        self.wait_for_end()
        self.assertRegex(self.farm("--status", out), "of 2 frames simulated 2, textured 2, drawn 2; done")

    def test_what_is_wrong_is_said_before_anything_is_submitted(self):
        out = self.out("wrong")
        for words, sentence in (
            (["--set", "texture.windwos=3"], "texture.windows"),
            (["--wedge", "texture.points"], "KEY=VALUE"),
            (["--wedge", "exemplar=/nowhere.png"], "/nowhere.png"),
            (["--chunk", "0"], "from 1 on"),
            (["--sbatch=--partition=nowhere"], "nowhere"),
        ):
            self.assertIn(sentence, self.farm(SCENE, *words, "--out", out, code=1))
        self.assertFalse(os.path.exists(os.path.join(out, "small")))
        self.assertEqual(self.slurm.ask("squeue", "--noheader"), "")


class WithoutSlurm(unittest.TestCase):
    def test_a_sentence_says_so_and_a_dry_run_prints_the_jobs(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("python3", "env"):
                os.symlink(shutil.which(name), os.path.join(folder, name))
            call = lambda *words: subprocess.run(
                [FARM, SCENE, "--program", PROGRAM, "--out", os.path.join(folder, "out"), *words],
                env={**os.environ, "PATH": folder},
                capture_output=True,
                text=True,
            )
            refused = call()
            self.assertEqual(refused.returncode, 1)
            self.assertIn("sbatch: is not installed", refused.stderr)
            printed = call("--dry-run", "--link", "2")
            self.assertEqual(printed.returncode, 0, printed.stderr)
            names = [
                line.partition(":")[0] for line in printed.stdout.splitlines() if not line.startswith(" ")
            ]
            self.assertEqual(
                names,
                [
                    "small/liquid",
                    "small/texture-1",
                    "small/texture-2",
                    "small/texture-3",
                    "small/draw",
                    "small/finish",
                ],
            )
            self.assertFalse(os.path.exists(os.path.join(folder, "out")))

    def test_variants_share_what_does_not_change_the_liquid(self):
        printed = subprocess.run(
            [
                FARM,
                SCENE,
                "--program",
                PROGRAM,
                "--dry-run",
                "--wedge",
                "domain.resolution=20,24",
                "--wedge",
                "camera.at=[0.5, 0.3, 0.2],[0.5, 0.3, 0.4]",
                "--out",
                "/nowhere",
            ],
            capture_output=True,
            text=True,
        )
        self.assertEqual(printed.returncode, 0, printed.stderr)
        waiting = re.findall(r"^(\S+)/texture-1: .*afterok:(\S+)$", printed.stdout, re.MULTILINE)
        self.assertEqual(
            waiting,
            [
                ("small/resolution-20-at-0.5-0.3-0.2", "small/liquid"),
                ("small/resolution-20-at-0.5-0.3-0.4", "small/liquid"),
                ("small/resolution-24-at-0.5-0.3-0.2", "small/liquid-2"),
                ("small/resolution-24-at-0.5-0.3-0.4", "small/liquid-2"),
            ],
        )

    def test_only_the_solver_is_called_once_for_all(self):
        for scene, given in (
            ("flows/stretch.toml", []),
            ("../tests/tools/small.toml", ["--set", "motion.flow=rotation"]),
        ):
            printed = subprocess.run(
                [FARM, os.path.join(ROOT, "scenes", scene), "--program", PROGRAM, "--dry-run", *given],
                capture_output=True,
                text=True,
            )
            self.assertEqual(printed.returncode, 0, printed.stderr)
            self.assertNotIn("simulate", printed.stdout)
            self.assertNotIn("motion.flow=files", printed.stdout)


if __name__ == "__main__":
    if cluster.missing():
        print(cluster.missing())
        sys.exit(77)
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
