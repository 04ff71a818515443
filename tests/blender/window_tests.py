# The add-on's panels and the button that textures a liquid, in a window of Blender's
# (tests/blender/in_window). The program is a stand-in that takes its time; steps follow one another by a
# timer, while the window draws itself.
import os
import shutil
import sys
import tempfile
import traceback

import bpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "..", "tools", "blender")]
import fluidtex
import mantaflow_scene as mantaflow
import small_run

folder = tempfile.mkdtemp(prefix="fluidtex ")
small_run.write_run(os.path.join(folder, "run"))
PROGRAM = """#!/bin/bash
trap "exit 130" INT
while [ $# -gt 0 ]; do [ "$1" = --out ] && out=$2; shift; done
mkdir -p "$out" && cp -r "${0%/*}/run/"* "$out"
for frame in 1 2 3; do echo "frame $frame/3: done" >&2; for part in 1 2 3 4 5; do sleep 0.2; done; done
"""
os.environ["FLUIDTEX"] = os.path.join(folder, "fluidtex")
with open(os.environ["FLUIDTEX"], "w") as file:
    file.write(PROGRAM)
os.chmod(os.environ["FLUIDTEX"], 0o755)


def in_view(act):
    """Calls act as if from the 3D view."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    with bpy.context.temp_override(
        window=window, area=area, region=next(region for region in area.regions if region.type == "WINDOW")
    ):
        return act()


def show_panel(context):
    next(
        area for area in bpy.context.window_manager.windows[0].screen.areas if area.type == "PROPERTIES"
    ).spaces.active.context = context


def choose(thing):
    for other in bpy.context.scene.objects:
        other.select_set(other == thing)
    bpy.context.view_layer.objects.active = thing


def expect(what, sentence):
    if not what:
        raise AssertionError(sentence)


def steps():
    """Yields the seconds that Blender is left alone for."""
    domain, _ = mantaflow.domain((-1, -1, 0), (1, 1, 2), 16, 3, os.path.join(folder, "cache"))
    os.makedirs(os.path.join(folder, "cache"), exist_ok=True)
    choose(domain)
    own = domain.fluidtex_texture
    own.exemplar, own.out = os.path.join(folder, "run", "noise.png"), os.path.join(folder, "out")
    yield 0.5
    show_panel("PHYSICS")
    yield 1.0
    expect(
        in_view(lambda: bpy.ops.fluidtex.texture("INVOKE_DEFAULT")) == {"RUNNING_MODAL"},
        "the button starts the work",
    )
    expect(not in_view(bpy.ops.fluidtex.texture.poll), "one at a time")
    yield 2.0
    expect(
        own.status.startswith("frame ") and own.status.endswith(" of 3"),
        f"progress is shown, not {own.status!r}",
    )
    expect(in_view(bpy.ops.fluidtex.stop) == {"FINISHED"}, "it can be stopped")
    yield 2.0
    expect("stopped" in own.status, f"that it stopped is said, not {own.status!r}")
    expect(
        not any(thing.fluidtex.surfaces for thing in bpy.context.scene.objects),
        "nothing is shown of stopped work",
    )
    expect(
        in_view(lambda: bpy.ops.fluidtex.texture("INVOKE_DEFAULT")) == {"RUNNING_MODAL"}, "it starts again"
    )
    yield 6.0
    expect(own.status == "done", f"it ends, not {own.status!r}")
    liquid = next(thing for thing in bpy.context.scene.objects if thing.fluidtex.surfaces)
    expect(len(liquid.data.vertices) == 144, "the result is shown")
    choose(liquid)
    yield 0.5
    show_panel("OBJECT")
    yield 1.0
    bpy.context.scene.frame_set(2)
    expect(len(liquid.data.vertices) == 256, "it follows the timeline")
    liquid.fluidtex.bump_map = own.exemplar
    expect(in_view(bpy.ops.fluidtex.material) == {"FINISHED"}, "its material is made anew")
    yield 1.0


def tick():
    try:
        return next(run)
    except StopIteration:
        code = 0
    except Exception:
        traceback.print_exc()
        code = 1
    shutil.rmtree(folder, ignore_errors=True)
    print("ok" if code == 0 else "failed", flush=True)
    os._exit(code)  # a window's Blender has no other way to end with a code


fluidtex.register()
run = steps()
bpy.app.timers.register(tick, first_interval=1.0)
