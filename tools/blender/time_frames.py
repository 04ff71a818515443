# How long Blender takes to go to a frame of a run: the add-on's handler reads the frame's PLY and fills the mesh.
# tools/measure_blender calls it:
#   blender -b --factory-startup -P time_frames.py -- OUT... [--goes N] [--json FILE]
import argparse
import json
import os
import statistics
import sys
import time

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import fluidtex


def arguments(words):
    options = argparse.ArgumentParser(
        prog="measure_blender", description="Times how Blender goes to a frame of a run."
    )
    options.add_argument("out", nargs="+", help="folder of a run with at least two frames")
    options.add_argument("--goes", type=int, default=5, help="of which the median counts (default: 5)")
    options.add_argument("--json", metavar="FILE", help="writes the figures there too")
    options = options.parse_args(words)
    if options.goes < 1:
        raise fluidtex.Problem("--goes: give a number above 0")
    return options


def timed(folder, goes):
    """{"vertices", "wall", "processor"} of going to the run's last frame from its first; seconds, medians."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if not hasattr(bpy.types.Object, "fluidtex"):
        fluidtex.register()
    frames = fluidtex.Run(folder).frames()
    if len(frames) < 2:
        raise fluidtex.Problem(f"{folder}: has one frame; give a run of two, between which Blender goes")
    liquid, scene = fluidtex.import_run(folder), bpy.context.scene
    wall, processor = [], []
    for _ in range(goes):
        scene.frame_set(frames[0])
        started, used = time.perf_counter(), time.process_time()
        scene.frame_set(frames[-1])
        wall.append(time.perf_counter() - started)
        processor.append(time.process_time() - used)
    if liquid.fluidtex.problem:
        raise fluidtex.Problem(liquid.fluidtex.problem)
    return {
        "vertices": len(liquid.data.vertices),
        "wall": statistics.median(wall),
        "processor": statistics.median(processor),
    }


def machine():
    """Processor and number of its cores that Blender may use."""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        names = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
    return f"{names[0] if names else '?'}, {len(os.sched_getaffinity(0))} cores"


def main(words):
    options = arguments(words)
    runs = []
    for folder in options.out:
        runs.append(timed(folder, options.goes))
        print("{vertices} points: {wall:.3g} s, {processor:.3g} s of the processor".format(**runs[-1]), flush=True)
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({"blender": bpy.app.version_string, "machine": machine(), "runs": runs}, file, indent=1)


if __name__ == "__main__":
    try:
        main(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
    except fluidtex.Problem as problem:
        print(f"error: {problem}", file=sys.stderr)
        sys.exit(1)
