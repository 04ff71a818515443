# Renders the frames of a run by Cycles, from the scene's own camera, in its own light, as
# OUT/cycles/NNNN.png; tools/render_cycles calls it:
#   blender -b --factory-startup -P render.py -- OUT [--frames A:B] [--size W H] ...
import argparse
import os
import sys
import tempfile

import bpy
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import fluidtex
import stage

_KNEE = 0.8  # values above are bent to below 1, as in the run's own pictures (render/render.cpp)


def arguments(words):
    options = argparse.ArgumentParser(
        prog="render_cycles", description="Renders the frames of a run by Cycles."
    )
    options.add_argument("out", help="folder of the run; pictures are written to its folder cycles")
    options.add_argument(
        "--frames", default="", metavar="A:B", help="first and last (default: all that have a surface)"
    )
    options.add_argument(
        "--size", type=int, nargs=2, metavar=("W", "H"), help="of the picture (default: the scene's)"
    )
    options.add_argument("--samples", type=int, help="a pixel (default: the scene's)")
    options.add_argument(
        "--shutter",
        type=float,
        default=0.0,
        metavar="FRAMES",
        help="how long it is open (default: 0, no motion blur)",
    )
    options.add_argument(
        "--shader", choices=["coat", "principled"], default="coat", help="coat: as the run's own pictures"
    )
    options.add_argument(
        "--color",
        metavar="PICTURE",
        help="a finer picture of the same exemplar (default: the scene's between_file, else the exemplar)",
    )
    for name in ("roughness", "normal", "bump", "displacement", "alpha"):
        options.add_argument(f"--{name}", metavar="PICTURE", help="map over the exemplar")
    options.add_argument(
        "--height",
        type=float,
        metavar="M",
        help="of white above black, with --bump and --displacement (default: 0.01)",
    )
    options.add_argument("--missing", action="store_true", help="only frames that have no picture yet")
    options.add_argument(
        "--plain", action="store_true", help="values above 0.8 are cut off at 1 instead of bent"
    )
    options.add_argument("--blend", metavar="FILE", help="saves the scene for Blender and renders nothing")
    options = options.parse_args(words)
    if (
        options.samples is not None
        and options.samples < 1
        or options.shutter < 0
        or options.size
        and min(options.size) < 1
    ):
        raise fluidtex.Problem("--samples, --size and --shutter: give numbers above 0")
    return options


def wanted_frames(text, there):
    if not text:
        return there
    try:
        first, last = (int(number) for number in (text.split(":") if ":" in text else (text, text)))
    except ValueError:
        raise fluidtex.Problem(
            f"--frames {text}: is no range of frames; write FIRST:LAST, such as 1:24"
        ) from None
    frames = [frame for frame in there if first <= frame <= last]
    if not frames:
        raise fluidtex.Problem(
            f"--frames {text}: the run has no surfaces there, but from {there[0]} to {there[-1]}"
        )
    return frames


def set_up(run, options):
    """The scene in Blender. Returns the liquid."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    stage.build(run)
    render = run.scene["render"]
    maps = {
        f"{name}_map": os.path.abspath(getattr(options, name))
        for name in ("color", "roughness", "normal", "bump", "displacement", "alpha")
        if getattr(options, name)
    }
    if run.between:
        maps.setdefault("color_map", run.between)
    if options.height is not None:
        maps["bump_distance"] = maps["displacement_scale"] = options.height
    liquid = fluidtex.import_run(run.folder, shader=options.shader.upper(), **maps)
    if liquid.fluidtex.problem:
        print(f"warning: {liquid.fluidtex.problem}", file=sys.stderr)

    scene.render.engine, scene.cycles.device = "CYCLES", "CPU"
    scene.cycles.samples = options.samples or render["samples"]
    scene.cycles.use_denoising = False
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.max_bounces = scene.cycles.diffuse_bounces = scene.cycles.glossy_bounces = render["bounces"]
    scene.cycles.caustics_reflective = scene.cycles.caustics_refractive = False
    scene.cycles.transparent_max_bounces = 32
    if options.size:
        scene.render.resolution_x, scene.render.resolution_y = options.size
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = (
        options.shutter > 0,
        options.shutter or 0.5,
    )
    scene.cycles.motion_blur_position = "CENTER"
    scene.view_settings.view_transform = "Standard"
    return liquid


def developed(radiance, exposure, plain):
    """sRGB bytes of linear light."""
    value = np.maximum(np.nan_to_num(radiance * exposure), 0.0)
    if not plain:
        value = np.where(
            value > _KNEE, _KNEE + (1 - _KNEE) * (1 - np.exp(-(value - _KNEE) / (1 - _KNEE))), value
        )
    value = np.minimum(value, 1.0)
    return np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)


def rendered(folder):
    """height x width x 4, linear, rows from the bottom."""
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
    return pixels.reshape(height, width, 4)


def write_png(pixels, file):
    """Appears under its name when it is whole."""
    height, width, _ = pixels.shape
    image = bpy.data.images.new("picture", width, height)
    image.pixels.foreach_set(np.ascontiguousarray(pixels, np.float32).ravel())
    # The frame is in it, since other machines may have the same numbers of processes.
    folder, name = os.path.split(file)
    unfinished = os.path.join(folder, f".tmp-{os.getpid()}-{name}")
    image.filepath_raw, image.file_format = unfinished, "PNG"
    try:
        image.save()
        os.replace(unfinished, file)
    except (OSError, RuntimeError) as error:
        raise fluidtex.Problem(f"{file}: cannot be written: {error}") from None
    finally:
        bpy.data.images.remove(image)


def main(words):
    options = arguments(words)
    if not hasattr(bpy.types.Object, "fluidtex"):
        fluidtex.register()
    run = fluidtex.Run(options.out)
    if not run.scene:
        raise fluidtex.Problem(f"{run.folder}: has no run.json, which says where the camera stands")
    frames = wanted_frames(options.frames, run.frames())
    set_up(run, options)
    if options.blend:
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(options.blend))
        print(f"saved {options.blend}; it needs the add-on tools/blender/fluidtex.py")
        return
    pictures = os.path.join(run.folder, "cycles")
    os.makedirs(pictures, exist_ok=True)
    picture_of = lambda frame: os.path.join(pictures, f"{frame:04d}.png")
    if options.missing:
        frames = [frame for frame in frames if not os.path.exists(picture_of(frame))]
    with tempfile.TemporaryDirectory() as folder:
        for count, frame in enumerate(frames, 1):
            bpy.context.scene.frame_set(frame)
            light = rendered(folder)
            light[..., :3] = developed(light[..., :3], run.scene["render"]["exposure"], options.plain)
            light[..., 3] = 1.0
            write_png(light, picture_of(frame))
            print(f"frame {frame} ({count}/{len(frames)})", flush=True)
    print(f"done: {pictures}")


if __name__ == "__main__":
    try:
        main(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
    except fluidtex.Problem as problem:
        print(f"error: {problem}", file=sys.stderr)
        sys.exit(1)
