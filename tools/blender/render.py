# Renders frames of a run by Cycles. `fluidtex render --cycles` starts it,
#   blender -b --factory-startup -P render.py
# with what is asked for as JSON on stdin (tools/draw_by_cycles.cpp):
#   run      folder with the surfaces
#   scene    as in run.json: camera, light and all that surrounds the liquid
#   origin   lowest corner of the domain
#   frames   to draw, in this order
#   pictures folder for them: NNNN.light, rows from the top, of pixels of three floats, linear
#   shutter  how long it is open, frames
#   shader   "coat", as in the run's own pictures, or "principled"
#   maps     over the exemplar: files by "color", "roughness", "normal", "bump", "displacement", "alpha"
#   height   of white above black in bump and displacement, m; or null
#   blend    file in which to save the scene, and draw nothing; or null
# On stdout "frame N" when a picture is there, and warnings; on stderr what is wrong.
import json
import os
import sys

import bpy
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import fluidtex
import stage


def maps_of(asked, run):
    """Files by what they say; the finer picture that the scene's own pictures show among them."""
    maps = dict(asked["maps"])
    own, texture = run.scene.get("texture") or {}, asked["scene"]["texture"]
    if texture.get("between") == "file":
        finer = texture["between_file"]
        # The run's own copy is sRGB, whatever the original is.
        copied = run.between and own.get("between_file") == finer
        maps.setdefault("color", run.between if copied else finer)
    return maps


def set_up(asked):
    """The scene in Blender."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene, current, render = asked["scene"], bpy.context.scene, asked["scene"]["render"]
    stage.build(scene, asked["origin"])
    run = fluidtex.Run(asked["run"])
    settings = {f"{name}_map": file for name, file in maps_of(asked, run).items()}
    if asked["height"] is not None:
        settings["bump_distance"] = settings["displacement_scale"] = asked["height"]
    run.scene = scene
    liquid = fluidtex.import_run(run, shader=asked["shader"].upper(), **settings)
    if liquid.fluidtex.problem:
        print(f"warning: {liquid.fluidtex.problem}", flush=True)

    kind = render.get("material", {}).get("kind", "coated")
    if kind != "coated":
        print(f'warning: Cycles draws the liquid coated, not as render.material.kind = "{kind}"', flush=True)
    if render.get("displacement", {}).get("map"):
        print("warning: Cycles leaves render.displacement out; give --map displacement=IMAGE", flush=True)

    current.render.engine, current.cycles.device = "CYCLES", "CPU"
    current.cycles.samples = render["samples"]
    current.cycles.use_denoising = False
    current.cycles.use_adaptive_sampling = False
    current.cycles.max_bounces = current.cycles.diffuse_bounces = current.cycles.glossy_bounces = render[
        "bounces"
    ]
    current.cycles.caustics_reflective = current.cycles.caustics_refractive = False
    current.cycles.transparent_max_bounces = 32
    current.render.use_motion_blur = asked["shutter"] > 0
    current.render.motion_blur_shutter = asked["shutter"] or 0.5
    current.cycles.motion_blur_position = "CENTER"
    current.view_settings.view_transform = "Standard"


def rendered(folder):
    """height x width x 3, linear, rows from the top."""
    scene = bpy.context.scene
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGB", "32"
    scene.render.filepath = os.path.join(folder, "light.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    pixels = np.empty(image.size[0] * image.size[1] * 4, np.float32)
    image.pixels.foreach_get(pixels)
    width, height = image.size
    bpy.data.images.remove(image)
    return pixels.reshape(height, width, 4)[::-1, :, :3]


def draw(asked):
    """Throws fluidtex.Problem."""
    if not hasattr(bpy.types.Object, "fluidtex"):
        fluidtex.register()
    set_up(asked)
    if asked["blend"]:
        bpy.ops.wm.save_as_mainfile(filepath=asked["blend"])
        return
    folder = asked["pictures"]
    for frame in asked["frames"]:
        bpy.context.scene.frame_set(frame)
        rendered(folder).astype("<f4").tofile(os.path.join(folder, f"{frame:04d}.light"))
        print(f"frame {frame}", flush=True)


if __name__ == "__main__":
    try:
        draw(json.load(sys.stdin))
    except fluidtex.Problem as problem:
        print(f"error: {problem}", file=sys.stderr)
        sys.exit(1)
