# Blender's liquid solver (mantaflow) on the closed dam break, timed step by step:
#   blender -b --factory-startup -t 1 -P mantaflow_dam_break.py -- CELLS FRAMES CFL CACHE_FOLDER
# Prints one line of JSON a frame: {"frame", "steps", "step_seconds" (processor time of the solver's steps
# alone), "seconds" (with what Blender does around them, writing its cache among it)}. The first frame puts
# the liquid there and is no part of any figure.
import gc
import json
import sys
import time
import types

import bpy

cells, frames, cfl, folder = sys.argv[sys.argv.index("--") + 1:]
cells, frames = int(cells), int(frames)
h = 1.0 / cells

for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
scene = bpy.context.scene
scene.render.fps = 24
scene.gravity = (0.0, 0.0, -9.81)
scene.frame_start, scene.frame_end = 1, frames


def box(name, low, high):
    bpy.ops.mesh.primitive_cube_add(size=1.0, location=[0.5 * (a + b) for a, b in zip(low, high)])
    thing = bpy.context.object
    thing.name = name
    thing.scale = [b - a for a, b in zip(low, high)]
    bpy.ops.object.transform_apply(location=False, rotation=False, scale=True)
    bpy.ops.object.modifier_add(type="FLUID")
    return thing


# One ring of cells is wall: CELLS of them are left inside.
domain = box("domain", (-h,) * 3, (1.0 + h,) * 3)
domain.modifiers[0].fluid_type = "DOMAIN"
settings = domain.modifiers[0].domain_settings
settings.domain_type = "LIQUID"
settings.resolution_max = cells + 2
settings.use_adaptive_timesteps = True
settings.cfl_condition = float(cfl)
settings.timesteps_min, settings.timesteps_max = 1, 4
settings.use_mesh = False
settings.cache_type = "REPLAY"
settings.cache_resumable = True
settings.cache_data_format = "OPENVDB"
settings.cache_frame_start, settings.cache_frame_end = 1, frames
settings.cache_directory = folder

liquid = box("liquid", (0.0, 0.0, 0.0), (0.4, 1.0, 0.5))
liquid.modifiers[0].fluid_type = "FLOW"
liquid.modifiers[0].flow_settings.flow_type = "LIQUID"
liquid.modifiers[0].flow_settings.flow_behavior = "GEOMETRY"

# Blender runs the solver as Python functions, in a module that scripts do not see; wrapped, each step tells its
# time.
steps = []


def watch():
    for step in gc.get_objects():
        if type(step) is not types.FunctionType or not step.__name__.startswith("liquid_step_"):
            continue
        space = step.__globals__
        if step.__name__[12:].isdigit() and space.get(step.__name__) is step:

            def timed(*arguments, step=step):
                start = time.process_time()
                result = step(*arguments)
                steps.append(time.process_time() - start)
                return result

            space[step.__name__] = timed


for frame in range(1, frames + 1):
    steps.clear()
    start = time.process_time()
    scene.frame_set(frame)
    seconds = time.process_time() - start
    print(json.dumps({"frame": frame, "steps": len(steps), "step_seconds": sum(steps), "seconds": seconds}),
          flush=True)
    watch()
