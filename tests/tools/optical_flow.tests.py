"""tools/optical_flow on pictures whose motion is known. Usage: optical_flow.tests.py TOOL. Exits with 77 without OpenCV."""
import json
import pathlib
import subprocess
import sys
import tempfile

try:
    import cv2
    import numpy
except ImportError:
    sys.exit(77)

TOOL = sys.argv[1]
SIZE = 160


def noise(seed):
    picture = numpy.random.default_rng(seed).random((SIZE, SIZE)).astype(numpy.float32)
    picture = cv2.GaussianBlur(picture, (0, 0), 2.0)
    return (255 * (picture - picture.min()) / (picture.max() - picture.min())).astype(numpy.uint8)


def write(folder, frame, picture, motion):
    cv2.imwrite(str(folder / f"{frame:04}.png"), picture)
    flow = numpy.full((SIZE, SIZE, 2), 1e10, numpy.float32)
    flow[20:-20, 20:-20] = motion
    cv2.writeOpticalFlow(str(folder / f"{frame:04}.flo"), flow)


def run(folder):
    file = folder / "figures.json"
    done = subprocess.run([sys.executable, TOOL, str(folder), "--json", str(file)], capture_output=True, text=True)
    return done, json.loads(file.read_text()) if file.exists() else None


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    done, found = run(folder)
    assert done.returncode != 0 and "no two frames in a row" in done.stderr, done.stderr

    # Three pixels to the right and two down from frame to frame.
    picture = noise(1)
    for frame in (1, 2, 3):
        moved = numpy.roll(picture, (2 * frame, 3 * frame), axis=(0, 1))
        write(folder, frame, moved, (-3.0, -2.0))
    done, found = run(folder)
    assert done.returncode == 0, done.stderr
    assert [row["frame"] for row in found["frames"]] == [2, 3]
    assert found["mean"]["error"] < 0.3, found
    assert found["mean"]["outliers"] < 0.02, found
    assert abs(found["mean"]["motion"] - 13.0 ** 0.5) < 1e-3, found

    # Texture that stays while the liquid is said to move: the error is the motion.
    for frame in (1, 2, 3):
        write(folder, frame, picture, (-3.0, -2.0))
    done, found = run(folder)
    assert abs(found["mean"]["error"] - 13.0 ** 0.5) < 0.1, found
    assert found["mean"]["outliers"] > 0.9, found

    (folder / "0002.png").write_bytes(b"no picture")
    done, found = run(folder)
    assert done.returncode == 1 and "0002.png: cannot be read as a picture" in done.stderr, done.stderr
