# What every script here says to Blender about a liquid of its solver (mantaflow): an empty scene, boxes, the domain,
# what flows in and what stands in the way. Metres, Z up; frames count from 1.
import bpy


def empty(frames, fps=24):
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    scene = bpy.context.scene
    scene.render.fps = fps
    scene.gravity = (0.0, 0.0, -9.81)
    scene.frame_start, scene.frame_end = 1, frames
    return scene


def box(name, low, high):
    """Blender's own cube of 2 m, moved and scaled: its scale stays in the object's matrix, as an artist leaves it."""
    bpy.ops.mesh.primitive_cube_add(size=2.0, location=[0.5 * (a + b) for a, b in zip(low, high)])
    thing = bpy.context.object
    thing.name = name
    thing.scale = [0.5 * (b - a) for a, b in zip(low, high)]
    return thing


def domain(low, high, cells, frames, folder):
    """CELLS along the longest side, the outermost of which are wall; all else is Blender's default. Returns the object
    and its settings."""
    thing = box("domain", low, high)
    bpy.ops.object.modifier_add(type="FLUID")
    thing.modifiers[0].fluid_type = "DOMAIN"
    settings = thing.modifiers[0].domain_settings
    settings.domain_type = "LIQUID"
    settings.resolution_max = cells
    settings.cache_frame_start, settings.cache_frame_end = 1, frames
    settings.cache_directory = folder
    return thing, settings


def liquid(thing, behavior="GEOMETRY"):
    bpy.context.view_layer.objects.active = thing
    bpy.ops.object.modifier_add(type="FLUID")
    thing.modifiers[0].fluid_type = "FLOW"
    settings = thing.modifiers[0].flow_settings
    settings.flow_type = "LIQUID"
    settings.flow_behavior = behavior
    return settings


def obstacle(thing):
    bpy.context.view_layer.objects.active = thing
    bpy.ops.object.modifier_add(type="FLUID")
    thing.modifiers[0].fluid_type = "EFFECTOR"
    return thing.modifiers[0].effector_settings


def closed_dam_break(cells, frames, folder):
    """A box of 1 m, liquid where x < 0.4 and z < 0.5; CELLS are left inside the walls."""
    h = 1.0 / cells
    thing, settings = domain((-h,) * 3, (1.0 + h,) * 3, cells + 2, frames, folder)
    liquid(box("liquid", (0.0, 0.0, 0.0), (0.4, 1.0, 0.5)))
    return thing, settings
