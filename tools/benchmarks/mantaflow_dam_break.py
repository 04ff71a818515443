# Blender's liquid solver (mantaflow) on the closed dam break, timed step by step:
#   blender -b --factory-startup -t 1 -P mantaflow_dam_break.py -- CELLS FRAMES CFL CACHE_FOLDER
# Prints one line of JSON a frame: {"frame", "steps", "step_seconds" (processor time of the solver's steps
# alone), "seconds" (with what Blender does around them, writing its cache among it)}. The first frame puts
# the liquid there and is no part of any figure.
import gc
import json
import os
import sys
import time
import types

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../tests/blender"))
import mantaflow_scene

cells, frames, cfl, folder = sys.argv[sys.argv.index("--") + 1:]
cells, frames = int(cells), int(frames)

scene = mantaflow_scene.empty(frames)
domain, settings = mantaflow_scene.closed_dam_break(cells, frames, folder)
settings.use_adaptive_timesteps = True
settings.cfl_condition = float(cfl)
settings.timesteps_min, settings.timesteps_max = 1, 4
settings.use_mesh = False
settings.cache_type = "REPLAY"
settings.cache_resumable = True
settings.cache_data_format = "OPENVDB"

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
