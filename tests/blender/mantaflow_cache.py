# Lets Blender's liquid solver (mantaflow) make a cache; tools/blender_cache calls it:
#   blender -b --factory-startup -t 1 -P mantaflow_cache.py -- FOLDER [--cells N] [--frames N] [--scene NAME] ...
# FOLDER gets Blender's files (config, data, mesh), the scene (scene.blend) and blender.json: how the domain stands
# and what Blender itself shows of each frame in the world, against which a reader of the cache can be checked.
# Prints one line of JSON a frame, with its processor time.
import argparse
import json
import math
import os
import sys
import time

import bpy
from mathutils import Euler, Matrix, Vector

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import mantaflow_scene as mantaflow

options = argparse.ArgumentParser(prog="blender_cache")
options.add_argument("folder")
options.add_argument("--cells", type=int, default=32, help="along the longest side")
options.add_argument("--frames", type=int, default=24)
options.add_argument("--scene", choices=["dam", "splash", "pour", "fall"], default="dam")
options.add_argument("--rate", type=int, default=24, help="frames a second")
options.add_argument("--time-scale", type=float, default=1.0, help="of the domain")
options.add_argument("--resumable", action="store_true", help="all grids, full floats; else Blender's default")
options.add_argument("--placed", action="store_true", help="the domain and all in it scaled, turned and moved")
options = options.parse_args(sys.argv[sys.argv.index("--") + 1:])
folder = os.path.abspath(options.folder)
if os.path.exists(os.path.join(folder, "config")):
    # Blender deletes the files of a cache as soon as a setting of its domain changes.
    sys.exit(f"{folder} holds a cache already: name another folder")


def dam():
    return mantaflow.closed_dam_break(options.cells, options.frames, folder)


def splash():
    """A dam breaks against a box that stands on the floor."""
    made = mantaflow.domain((-1.0, -0.5, 0.0), (1.0, 0.5, 1.25), options.cells, options.frames, folder)
    mantaflow.liquid(mantaflow.box("liquid", (-1.1, -0.6, -0.1), (-0.4, 0.6, 0.8)))
    mantaflow.obstacle(mantaflow.box("obstacle", (0.2, -0.2, -0.1), (0.45, 0.2, 0.4)))
    return made


def pour():
    """Something like honey falls on the floor as a rope."""
    made = mantaflow.domain((-0.5, -0.5, 0.0), (0.5, 0.5, 1.0), options.cells, options.frames, folder)
    made[1].use_viscosity = True
    made[1].viscosity_value = 1.5
    bpy.ops.mesh.primitive_cylinder_add(radius=0.08, depth=0.1, location=(0.0, 0.0, 0.85))
    bpy.context.object.name = "inflow"
    flow = mantaflow.liquid(bpy.context.object, "INFLOW")
    flow.use_initial_velocity = True
    flow.velocity_coord = (0.0, 0.0, -0.5)
    return made


def fall():
    """A block of liquid in free fall, all of the frames."""
    made = mantaflow.domain((-0.5, -0.5, 0.0), (0.5, 0.5, 2.0), options.cells, options.frames, folder)
    mantaflow.liquid(mantaflow.box("liquid", (-0.25, -0.25, 1.3), (0.25, 0.25, 1.8)))
    return made


def shown(domain):
    """The liquid's mesh as Blender shows it in this frame, in the world."""
    evaluated = domain.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    points = [evaluated.matrix_world @ vertex.co for vertex in mesh.vertices]
    result = {
        "vertices": len(points),
        "triangles": len(mesh.polygons),
        "low": [min((p[i] for p in points), default=None) for i in range(3)],
        "high": [max((p[i] for p in points), default=None) for i in range(3)],
        "first": [list(p) for p in points[:3]],
    }
    evaluated.to_mesh_clear()
    return result


scene = mantaflow.empty(options.frames, options.rate)
domain, settings = {"dam": dam, "splash": splash, "pour": pour, "fall": fall}[options.scene]()
settings.use_mesh = True
settings.time_scale = options.time_scale
if options.resumable:
    settings.cache_resumable = True
    settings.openvdb_data_depth = "32"
if options.placed:
    place = Matrix.LocRotScale(Vector((3, -2, 1)), Euler((0, 0, math.radians(30))), Vector((1.5, 1, 0.8)))
    bpy.context.view_layer.update()
    for thing in scene.objects:
        thing.matrix_world = place @ thing.matrix_world

os.makedirs(folder, exist_ok=True)
frames = {}
for frame in range(1, options.frames + 1):
    start = time.process_time()
    scene.frame_set(frame)  # makes the frame and writes its files
    seconds = time.process_time() - start
    frames[frame] = shown(domain)
    print(json.dumps({"frame": frame, "seconds": round(seconds, 3), "vertices": frames[frame]["vertices"]}), flush=True)

with open(os.path.join(folder, "blender.json"), "w") as file:
    about = {
        "blender": bpy.app.version_string,
        "scene": options.scene,
        "frames_per_second": scene.render.fps,
        "time_scale": options.time_scale,
        "cell": 2.0 * max(column.length for column in domain.matrix_world.to_3x3().col) / settings.resolution_max,
        "matrix": [list(row) for row in domain.matrix_world],
        "shown": frames,
    }
    json.dump(about, file)
bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "scene.blend"))
