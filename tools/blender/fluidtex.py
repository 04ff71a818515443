# Blender add-on: textured liquids of fluidtex on the timeline, and the texture itself on a liquid that is
# baked here. What arrives as which attribute, and how to use it: docs/tutorial-blender.md. Made and tested
# with Blender 3.4; where later versions differ, the code says so.
#
# Without a window:
#   import fluidtex; fluidtex.register()
#   liquid = fluidtex.import_run("out/dam_break")
#   fluidtex.texture("cache_fluid", "lava.jpg", "out/lava")      # blocks; then import_run("out/lava")
import atexit
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import threading
from collections import deque

import bpy
import numpy as np
from bpy.app.handlers import persistent
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

bl_info = {
    "name": "fluidtex",
    "author": "the fluidtex project",
    "version": (1, 0, 0),
    "blender": (3, 4, 0),
    "location": "File > Import > fluidtex run; Properties > Physics > Texture this liquid",
    "description": "Textured liquids on the timeline, and texture for a baked liquid",
    "category": "Import-Export",
}


class Problem(Exception):
    """One sentence for the user: what is wrong with which file or setting."""


# ---- files of a run ----------------------------------------------------------------------------------------
# Their format is documented in docs/reference/files.md.

_NUMBERS = {
    "char": "i1",
    "uchar": "u1",
    "short": "<i2",
    "ushort": "<u2",
    "int": "<i4",
    "uint": "<u4",
    "float": "<f4",
    "double": "<f8",
}
_FACE = np.dtype([("n", "u1"), ("v", "<i4", 3)])
# Of each corner L's piece of texture, its place at each corner C: st[L, C].
_JOINT = np.dtype([("face", "<i4"), ("st", "<f4", (3, 3, 2)), ("fade_st", "<f4", (3, 3, 2))])
_JOINT_PROPERTIES = ["face"] + [
    f"{fade}{axis}{label}{corner}"
    for fade in ("", "fade_")
    for label in range(3)
    for corner in range(3)
    for axis in "st"
]


def _elements(data, path):
    """Where each element of a PLY file lies: [(name, count, [(property, type)])], and where its header
    ends."""
    end = data.find(b"end_header\n", 0, 1 << 16)
    if not data.startswith(b"ply\nformat binary_little_endian 1.0\n") or end < 0:
        raise Problem(f"{path}: is no surface of fluidtex; give a binary little-endian PLY file")
    elements = []
    try:
        for line in data[:end].decode("ascii", "replace").split("\n"):
            words = line.split()
            if words[:1] == ["element"]:
                elements.append((words[1], int(words[2]), []))
            elif words[:2] == ["property", "list"]:
                elements[-1][2].append((words[-1], "list"))
            elif words[:1] == ["property"]:
                elements[-1][2].append((words[2], words[1]))
        for _, count, properties in elements:
            if count < 0 or len(dict(properties)) < len(properties):
                raise ValueError
    except (ValueError, IndexError):
        raise Problem(f"{path}: its header is damaged; let fluidtex write it again") from None
    return elements, end + len(b"end_header\n")


def read_ply(path):
    """{"vertex", "face", "joint"}: a structured array each, of a file that fluidtex has written; "joint" is
    None where the file has no such element. Nothing is parsed: each element is a block of equal records."""
    try:
        with open(path, "rb") as file:
            data = file.read()
    except OSError as error:
        raise Problem(f"{path}: cannot be read: {error.strerror}") from None
    elements, offset = _elements(data, path)
    result = {"vertex": None, "face": None, "joint": None}
    for name, count, properties in elements:
        if name == "face":
            if properties != [("vertex_indices", "list")]:
                raise Problem(
                    f"{path}: its faces have other properties than vertex_indices; give a surface of fluidtex"
                )
            record = _FACE
        else:
            if any(kind not in _NUMBERS for _, kind in properties):
                raise Problem(f"{path}: its element {name} is not of numbers; give a surface of fluidtex")
            record = np.dtype([(prop, _NUMBERS[kind]) for prop, kind in properties])
        if name == "joint":
            if [prop for prop, _ in properties] != _JOINT_PROPERTIES or record.itemsize != _JOINT.itemsize:
                raise Problem(
                    f"{path}: its joints are of another version of fluidtex than this add-on; "
                    "install the one beside it"
                )
            record = _JOINT
        if len(data) < offset + count * record.itemsize:
            raise Problem(f"{path}: is cut short; let fluidtex write it again")
        result[name] = np.frombuffer(data, record, count, offset)
        offset += count * record.itemsize
    if result["vertex"] is None or result["face"] is None:
        raise Problem(f"{path}: lacks vertices or faces; give a surface of fluidtex")
    if not (result["face"]["n"] == 3).all():
        raise Problem(f"{path}: has faces that are no triangles; give a surface of fluidtex")
    corners, joints = result["face"]["v"], result["joint"]
    if corners.size and not (0 <= corners.min() and corners.max() < len(result["vertex"])):
        raise Problem(f"{path}: a triangle has a corner that is not there; let fluidtex write it again")
    if (
        joints is not None
        and len(joints)
        and not (0 <= joints["face"].min() and joints["face"].max() < len(corners))
    ):
        raise Problem(f"{path}: a joint is of a triangle that is not there; let fluidtex write it again")
    if not set("xyz") <= set(result["vertex"].dtype.names):
        raise Problem(f"{path}: its vertices have no positions; give a surface of fluidtex")
    return result


class Run:
    """A finished or growing run, as far as Blender needs it. `path`: its folder, run.json, surface/, onto/,
    or a PLY file in one of these."""

    def __init__(self, path):
        path = os.path.abspath(bpy.path.abspath(path)).rstrip(os.sep)
        inside = path if os.path.isdir(path) else os.path.dirname(path)
        if os.path.basename(inside) in ("surface", "onto"):
            self.surfaces, folder = inside, os.path.dirname(inside)
        else:
            self.surfaces, folder = os.path.join(inside, "surface"), inside
        if not self.frames():
            raise Problem(f"{path}: holds no surface/NNNN.ply; give the folder of a run of fluidtex")
        self.folder = folder
        report, self.scene, self.spacing = {}, {}, {}
        try:
            with open(os.path.join(folder, "run.json"), encoding="utf-8") as file:
                report = json.load(file)
            self.scene = report["scene"]
            self.spacing = {frame["frame"]: frame.get("spacing") for frame in report["frames"]}
        except FileNotFoundError:
            pass  # meshes alone: colours, at the scene's frame rate
        except (OSError, ValueError, KeyError) as error:
            raise Problem(
                f"{os.path.join(folder, 'run.json')}: cannot be read ({error}); let fluidtex write it again"
            ) from None
        texture = self.scene.get("texture") or {}
        self.frame_rate = float(self.scene.get("frame_rate") or 0)
        # The run's own copies go with its folder, and are sRGB whatever the originals were.
        own = {name: os.path.join(folder, f"{name}.png") for name in ("exemplar", "between")}
        own = {name: file for name, file in own.items() if os.path.exists(file)}
        self.exemplar = own.get("exemplar") or texture.get("exemplar") or ""
        # The finer picture of the exemplar that its own pictures show.
        finer = texture.get("between") == "file"
        self.between = (own.get("between") or texture.get("between_file") or "") if finer else ""
        self.toroidal = bool(texture.get("toroidal"))
        # Else colours were carried, and no place in the exemplar has them. Of an exemplar that moves the points
        # have the colours of their frame.
        moves = bool((report.get("inputs") or {}).get("texture.exemplar", {}).get("count"))
        self.looked_up = (
            texture.get("method") == "coordinates"
            and texture.get("later_frames", "synthesize") in ("synthesize", "alone")
            and not moves
        )

    def frames(self):
        """Numbers of the frames that have a surface now, ascending."""
        try:
            names = os.listdir(self.surfaces)
        except OSError:
            return []
        return sorted(int(name[:-4]) for name in names if re.fullmatch(r"\d+\.ply", name))

    def has_places(self):
        """Whether its surfaces say where in the exemplar the colour of every place comes from."""
        if not self.looked_up:
            return False
        with open(self.file(self.frames()[0]), "rb") as file:
            elements, _ = _elements(file.read(1 << 16), file.name)
        return "joint" in (name for name, _, _ in elements)

    def file(self, frame):
        return os.path.join(self.surfaces, f"{frame:04d}.ply")


# ---- the mesh ----------------------------------------------------------------------------------------------

# Properties of a vertex that become one attribute; all others keep their names.
_GROUPS = {
    "surface_normal": ("nx", "ny", "nz"),
    "orientation": ("dx", "dy", "dz"),
    "previous_position": ("bx", "by", "bz"),
    "velocity": ("vx", "vy", "vz"),
    "st": ("s", "t"),
    "fade_st": ("fade_s", "fade_t"),
    "gradient_s": ("sx", "sy", "sz"),
    "gradient_t": ("tx", "ty", "tz"),
    "fade_gradient_s": ("fade_sx", "fade_sy", "fade_sz"),
    "fade_gradient_t": ("fade_tx", "fade_ty", "fade_tz"),
}
_KINDS = {
    1: ("FLOAT", "value"),
    2: ("FLOAT2", "vector"),
    3: ("FLOAT_VECTOR", "vector"),
    4: ("FLOAT_COLOR", "color"),
}
# Attributes that Blender has for something else, and makes no other of.
_OF_BLENDER = ("position", "normal", "id", "material_index", "shade_smooth", "crease", "sharp_face", "sharp_edge")
UV_MAPS = ("exemplar", "exemplar1", "exemplar2")  # of the place that is shown, of each corner's piece
FORMER_UV_MAPS = ("former", "former1", "former2")  # of the place that fades
CORNER = "corner"  # (1,0,0), (0,1,0), (0,0,1): inside, the barycentric coordinates

_CODES = np.arange(256) / 255
_DECODED = np.where(_CODES <= 0.04045, _CODES / 12.92, ((_CODES + 0.055) / 1.055) ** 2.4).astype(np.float32)


def attribute_groups(properties):
    """{attribute: its properties}, of the properties of a vertex but its position and colour."""
    left = [name for name in properties if name not in ("x", "y", "z", "red", "green", "blue", "alpha")]
    groups = {}
    for attribute, names in _GROUPS.items():
        if all(name in left for name in names):
            groups[attribute] = names
            left = [name for name in left if name not in names]

    def add(attribute, names):
        while attribute in groups:
            attribute += "_"
        groups[attribute] = names

    for name in list(left):
        for ending in (("_x", "_y", "_z"), ("_red", "_green", "_blue")):
            stem = name[: -len(ending[0])]
            names = tuple(stem + part for part in ending)
            if stem and name == names[0] and all(part in left for part in names):
                add(stem, names)
                left = [other for other in left if other not in names]
    for name in left:
        add(name, (name,))
    taken = (*_OF_BLENDER, "Col", CORNER, *UV_MAPS, *FORMER_UV_MAPS)
    return {name + "_" if name in taken else name: names for name, names in groups.items()}


def columns(vertices, names):
    """#V x len(names), float; one copy, of neighbouring floats in one go."""
    fields = [vertices.dtype.fields[name] for name in names]
    first = fields[0][1]
    if all(kind == np.dtype("<f4") and place == first + 4 * k for k, (kind, place) in enumerate(fields)):
        wide = np.dtype(
            {
                "names": ["all"],
                "formats": [("<f4", (len(names),))],
                "offsets": [first],
                "itemsize": vertices.dtype.itemsize,
            }
        )
        return np.ascontiguousarray(vertices.view(wide)["all"])
    result = np.empty((len(vertices), len(names)), np.float32)
    for k, name in enumerate(names):
        result[:, k] = vertices[name]
    return result


def _set_attribute(mesh, name, domain, values):
    kind, key = _KINDS[values.shape[1]]
    mesh.attributes.new(name, kind, domain).data.foreach_set(key, values.ravel())


def _set_uv_maps(mesh, names, st, corners, joint_faces, joint_st):
    """One UV map for the piece of each corner of a triangle. They differ in joint triangles only. Blender's v
    runs upwards."""
    uv = np.array(st)
    uv[:, 1] = 1 - uv[:, 1]
    whole = uv.view(np.uint64).ravel()[corners.ravel()].view(np.float32).reshape(-1, 3, 2)
    for label, name in enumerate(names):
        if len(joint_faces):
            there = joint_st[:, label].copy()
            there[..., 1] = 1 - there[..., 1]
            whole[joint_faces] = there
        mesh.uv_layers.new(name=name, do_init=False).data.foreach_set("uv", whole.ravel())


def fill(mesh, surface, velocity_factor=1.0, custom_normals=False):
    """Replaces all geometry of the mesh by a surface of read_ply(). Uses no operator, so that it works while
    rendering."""
    vertices, joints = surface["vertex"], surface["joint"]
    corners = np.ascontiguousarray(surface["face"]["v"])
    count, faces = len(vertices), len(corners)
    mesh.clear_geometry()
    if count == 0:
        return
    mesh.vertices.add(count)
    mesh.loops.add(3 * faces)
    mesh.polygons.add(faces)
    mesh.vertices.foreach_set("co", columns(vertices, "xyz").ravel())
    mesh.loops.foreach_set("vertex_index", corners.ravel())
    mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * faces, 3, dtype=np.int32))
    totals = bpy.types.MeshPolygon.bl_rna.properties["loop_total"]
    if not totals.is_readonly:  # as in later versions, where they follow from loop_start
        mesh.polygons.foreach_set("loop_total", np.full(faces, 3, np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(faces, bool))
    mesh.update(calc_edges=True)

    properties = vertices.dtype.names
    if "red" in properties:
        bytes_ = np.stack([vertices[name] for name in ("red", "green", "blue", "alpha")], 1)
        color = _DECODED[bytes_]
        color[:, 3] = bytes_[:, 3] / np.float32(255)
        _set_attribute(mesh, "Col", "POINT", color)
    for name, names in attribute_groups(properties).items():
        values = columns(vertices, names)
        if name == "velocity" and velocity_factor != 1.0:
            values *= np.float32(velocity_factor)
        _set_attribute(mesh, name, "POINT", values)
    if joints is not None and "fade_s" in properties:
        for maps, names, record in (
            (UV_MAPS, ("s", "t"), "st"),
            (FORMER_UV_MAPS, ("fade_s", "fade_t"), "fade_st"),
        ):
            _set_uv_maps(mesh, maps, columns(vertices, names), corners, joints["face"], joints[record])
        _set_attribute(mesh, CORNER, "CORNER", np.tile(np.eye(3, dtype=np.float32), (faces, 1)))
    if custom_normals:
        mesh.normals_split_custom_set_from_vertices(columns(vertices, ("nx", "ny", "nz")))
        if hasattr(mesh, "use_auto_smooth"):  # until 4.0; later, custom normals count by themselves
            mesh.use_auto_smooth = True


# ---- the material ------------------------------------------------------------------------------------------

_MEAN_HALVINGS = 3  # means are over 8 x 8 pixels of the exemplar, as texture/shown/shown_color.h has it
_SAME = 1e-3  # squared differences of lightness below this count as none


class Nodes:
    """Short words for making nodes of one tree. Sockets and numbers can stand for each other as inputs."""

    def __init__(self, tree, clear=True):
        self.tree = tree
        if clear:
            tree.nodes.clear()

    def new(self, kind, **settings):
        node = self.tree.nodes.new(kind)
        for name, value in settings.items():
            setattr(node, name, value)
        return node

    def put(self, value, socket):
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        else:
            socket.default_value = value

    def math(self, operation, *inputs):
        node = self.new("ShaderNodeMath", operation=operation)
        for value, socket in zip(inputs, node.inputs):
            self.put(value, socket)
        return node.outputs[0]

    def vector(self, operation, *inputs, output="Vector"):
        node = self.new("ShaderNodeVectorMath", operation=operation)
        sockets = [socket for socket in node.inputs if socket.enabled]
        for value, socket in zip(inputs, sockets):
            self.put(value, socket)
        return node.outputs[output]

    def scaled(self, vector, factor):
        node = self.new("ShaderNodeVectorMath", operation="SCALE")
        self.put(vector, node.inputs[0])
        self.put(factor, node.inputs["Scale"])
        return node.outputs[0]

    def mixed(self, weight, a, b):
        """a (1 - weight) + b weight, of vectors and colours."""
        return self.vector("ADD", a, self.scaled(self.vector("SUBTRACT", b, a), weight))

    def attribute(self, name, output):
        return self.new("ShaderNodeAttribute", attribute_name=name).outputs[output]

    def parts(self, vector):
        node = self.new("ShaderNodeSeparateXYZ")
        self.put(vector, node.inputs[0])
        return node.outputs

    def sum(self, terms):
        total = terms[0]
        for term in terms[1:]:
            total = self.vector("ADD", total, term)
        return total


def _new_group(name, inputs, outputs):
    """A node group of that name with sockets {name: type}. One that is there keeps them, and so its links to
    other nodes."""
    group = bpy.data.node_groups.get(name)
    if group is None:
        group = bpy.data.node_groups.new(name, "ShaderNodeTree")
        for direction, own, sockets in (("INPUT", "inputs", inputs), ("OUTPUT", "outputs", outputs)):
            for socket, kind in sockets.items():
                if bpy.app.version >= (4, 0):
                    group.interface.new_socket(socket, in_out=direction, socket_type=kind)
                else:
                    getattr(group, own).new(kind, socket)
    return group


def _look_up_group(run, image, holds, inputs, outputs):
    return _new_group(
        f"fluidtex {holds} of {image.name}{' repeated' if run.toroidal else ''}", inputs, outputs
    )


def _fade_group():
    """The law by which the place that is shown and the one that fades are mixed: texture/shown/shown_color.h.
    Gives the share of the colour that is shown."""
    number = "NodeSocketFloat"
    group = _new_group(
        "fluidtex fade",
        {
            "Shown": "NodeSocketColor",
            "Former": "NodeSocketColor",
            "Shown Mean": number,
            "Former Mean": number,
            "Weight": number,
        },
        {"Share": number},
    )
    nodes = Nodes(group)
    inputs = nodes.new("NodeGroupInput").outputs
    weight, shown_mean, former_mean = inputs["Weight"], inputs["Shown Mean"], inputs["Former Mean"]
    math = nodes.math

    def either(condition, yes, no):
        return math(
            "ADD", math("MULTIPLY", condition, yes), math("MULTIPLY", math("SUBTRACT", 1.0, condition), no)
        )

    def encoded(linear):
        curve = math("SUBTRACT", math("MULTIPLY", math("POWER", linear, 1 / 2.4), 1.055), 0.055)
        return either(math("LESS_THAN", linear, 0.0031308), math("MULTIPLY", linear, 12.92), curve)

    def decoded(value):
        curve = math("POWER", math("DIVIDE", math("ADD", value, 0.055), 1.055), 2.4)
        return either(math("LESS_THAN", value, 0.04045), math("DIVIDE", value, 12.92), curve)

    def lightness(color):
        return encoded(nodes.vector("DOT_PRODUCT", color, (0.2126, 0.7152, 0.0722), output="Value"))

    one, other = lightness(inputs["Shown"]), lightness(inputs["Former"])
    angle = math("MULTIPLY", weight, np.pi / 2)
    mean = math("ADD", shown_mean, math("MULTIPLY", weight, math("SUBTRACT", former_mean, shown_mean)))
    detail = math(
        "ADD",
        math("MULTIPLY", math("COSINE", angle), math("SUBTRACT", one, shown_mean)),
        math("MULTIPLY", math("SINE", angle), math("SUBTRACT", other, former_mean)),
    )
    wanted = math(
        "MINIMUM",
        math("MAXIMUM", math("ADD", mean, detail), math("MINIMUM", one, other)),
        math("MAXIMUM", one, other),
    )
    start = decoded(other)
    # A Math node gives 0 where it divides by 0, which is what is wanted of colours that are equally bright.
    along = math("DIVIDE", math("SUBTRACT", decoded(wanted), start), math("SUBTRACT", decoded(one), start))
    apart = math("SUBTRACT", one, other)
    squared = math("MULTIPLY", apart, apart)
    share = math(
        "DIVIDE",
        math("ADD", math("MULTIPLY", along, squared), math("MULTIPLY", math("SUBTRACT", 1.0, weight), _SAME)),
        math("ADD", squared, _SAME),
    )
    nodes.put(share, nodes.new("NodeGroupOutput").inputs["Share"])
    return group


def _load_image(path, is_data):
    path = os.path.abspath(bpy.path.abspath(path))
    for image in bpy.data.images:  # a picture may be used as colours and as numbers: two images then
        if (
            image.source == "FILE"
            and os.path.abspath(bpy.path.abspath(image.filepath)) == path
            and image.colorspace_settings.is_data == is_data
        ):
            break
    else:
        try:
            image = bpy.data.images.load(path)
        except RuntimeError:
            image = None
        if image is None or 0 in image.size:  # which loads it
            if image is not None:
                bpy.data.images.remove(image)
            raise Problem(f"{path}: is no picture that Blender reads; give a PNG, JPEG, TIFF or OpenEXR file")
        if bpy.data.filepath:  # so that both can be moved together
            image.filepath = bpy.path.relpath(path)
        if is_data:
            image.colorspace_settings.is_data = True
    image.alpha_mode = "CHANNEL_PACKED"  # colours as they are; the group weights them by alpha itself
    return image


def _pixels(image):
    """height x width x 4, rows from the top, linear."""
    width, height = image.size
    pixels = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(height, width, 4)[::-1]
    if not image.is_float and not image.colorspace_settings.is_data:  # bytes come as they are stored
        color = pixels[..., :3]
        pixels = np.concatenate(
            [np.where(color <= 0.04045, color / 12.92, ((color + 0.055) / 1.055) ** 2.4), pixels[..., 3:]], 2
        )
    return pixels


def _mean_lightness(image, exemplar_width, toroidal):
    """An image of the mean lightness around each place of a picture, and by how much its extent is larger
    than the picture's."""
    pixels = _pixels(image)
    luminance = (pixels[..., :3] * pixels[..., 3:]) @ np.array([0.2126, 0.7152, 0.0722])
    means = np.where(
        luminance <= 0.0031308, 12.92 * luminance, 1.055 * np.maximum(luminance, 0) ** (1 / 2.4) - 0.055
    )
    halvings = max(0, _MEAN_HALVINGS + round(np.log2(image.size[0] / max(exemplar_width, 1))))
    for _ in range(halvings):
        odd = [(0, size % 2) for size in means.shape]
        means = np.pad(means, odd, mode="wrap" if toroidal else "edge")
        means = (means[0::2, 0::2] + means[1::2, 0::2] + means[0::2, 1::2] + means[1::2, 1::2]) / 4
    height, width = means.shape
    name = f"fluidtex means of {image.name}"
    old = bpy.data.images.get(name)
    if old:
        bpy.data.images.remove(old)
    result = bpy.data.images.new(name, width, height, float_buffer=True, is_data=True)
    rgba = np.ones((height, width, 4), np.float32)
    rgba[..., :3] = means[::-1, :, None]
    result.pixels.foreach_set(rgba.ravel())
    result.update()
    result.pack()  # a generated picture is not saved otherwise
    side = 2**halvings
    return result, (image.size[0] / (side * width), image.size[1] / (side * height))


def _look_up(nodes, image, uv_map, toroidal, extent=(1.0, 1.0)):
    """The image texture node at a UV map's place. extent: of the picture in the image, from its top left
    corner on."""
    place = nodes.new("ShaderNodeUVMap", uv_map=uv_map).outputs[0]
    if extent != (1.0, 1.0):
        place = nodes.vector("MULTIPLY_ADD", place, (*extent, 1.0), (0.0, 1.0 - extent[1], 0.0))
    node = nodes.new(
        "ShaderNodeTexImage",
        image=image,
        interpolation="Linear",
        extension="REPEAT" if toroidal else "EXTEND",
    )
    nodes.put(place, node.inputs[0])
    return node


def _corner_weights(nodes):
    return nodes.parts(nodes.attribute(CORNER, "Vector"))


def color_group(run, path):
    """Node group: the colours of a picture over the exemplar, as the run shows them; outputs Color and
    Alpha."""
    image = _load_image(path, False)
    exemplar = _load_image(run.exemplar, False)
    means, extent = _mean_lightness(image, exemplar.size[0], run.toroidal)
    fade = _fade_group()
    see_through = image.channels == 4 and bool((_pixels(image)[..., 3] < 1).any())
    group = _look_up_group(
        run, image, "colours", {}, {"Color": "NodeSocketColor", "Alpha": "NodeSocketFloat"}
    )
    nodes = Nodes(group)
    corner = _corner_weights(nodes)

    def layer(maps):
        """Of the three pieces: premultiplied colour, alpha, mean lightness."""
        colors, alphas, lightnesses = [], [], []
        for weight, uv_map in zip(corner, maps):
            texture = _look_up(nodes, image, uv_map, run.toroidal)
            part = weight
            if see_through:
                part = nodes.math("MULTIPLY", weight, texture.outputs["Alpha"])
                alphas.append(part)
            colors.append(nodes.scaled(texture.outputs["Color"], part))
            lightnesses.append(
                nodes.scaled(_look_up(nodes, means, uv_map, run.toroidal, extent).outputs["Color"], weight)
            )
        alpha = nodes.math("ADD", nodes.math("ADD", alphas[0], alphas[1]), alphas[2]) if see_through else 1.0
        return nodes.sum(colors), alpha, nodes.parts(nodes.sum(lightnesses))[0]

    shown, shown_alpha, shown_mean = layer(UV_MAPS)
    former, former_alpha, former_mean = layer(FORMER_UV_MAPS)
    node = nodes.new("ShaderNodeGroup", node_tree=fade)
    for value, socket in zip(
        (shown, former, shown_mean, former_mean, nodes.attribute("fade", "Fac")), node.inputs
    ):
        nodes.put(value, socket)
    color, alpha = nodes.mixed(node.outputs["Share"], former, shown), 1.0
    if see_through:
        alpha = nodes.math(
            "ADD",
            former_alpha,
            nodes.math("MULTIPLY", node.outputs["Share"], nodes.math("SUBTRACT", shown_alpha, former_alpha)),
        )
        color = nodes.scaled(color, nodes.math("DIVIDE", 1.0, alpha))
    output = nodes.new("NodeGroupOutput")
    nodes.put(color, output.inputs["Color"])
    nodes.put(alpha, output.inputs["Alpha"])
    return group


def value_group(run, path):
    """Node group: the numbers of a picture over the exemplar; outputs Color (three of them) and Value (the
    first)."""
    image = _load_image(path, True)
    group = _look_up_group(run, image, "values", {}, {"Color": "NodeSocketColor", "Value": "NodeSocketFloat"})
    nodes = Nodes(group)
    corner = _corner_weights(nodes)

    def layer(maps):
        return nodes.sum(
            [
                nodes.scaled(_look_up(nodes, image, uv_map, run.toroidal).outputs["Color"], weight)
                for weight, uv_map in zip(corner, maps)
            ]
        )

    mixed = nodes.mixed(nodes.attribute("fade", "Fac"), layer(UV_MAPS), layer(FORMER_UV_MAPS))
    output = nodes.new("NodeGroupOutput")
    nodes.put(mixed, output.inputs["Color"])
    nodes.put(nodes.parts(mixed)[0], output.inputs["Value"])
    return group


def normal_group(run, path):
    """Node group: normals of a tangent-space normal map (green upwards) over the exemplar, turned as each
    piece lies; output Normal, and input Strength."""
    image = _load_image(path, True)
    group = _look_up_group(
        run, image, "normals", {"Strength": "NodeSocketFloat"}, {"Normal": "NodeSocketVector"}
    )
    nodes = Nodes(group)
    corner = _corner_weights(nodes)
    strength = nodes.new("NodeGroupInput").outputs["Strength"]

    def layer(maps):
        normals = []
        for weight, uv_map in zip(corner, maps):
            node = nodes.new("ShaderNodeNormalMap", uv_map=uv_map)
            nodes.put(_look_up(nodes, image, uv_map, run.toroidal).outputs["Color"], node.inputs["Color"])
            nodes.put(strength, node.inputs["Strength"])
            normals.append(nodes.scaled(node.outputs["Normal"], weight))
        return nodes.sum(normals)

    mixed = nodes.mixed(nodes.attribute("fade", "Fac"), layer(UV_MAPS), layer(FORMER_UV_MAPS))
    nodes.put(nodes.vector("NORMALIZE", mixed), nodes.new("NodeGroupOutput").inputs["Normal"])
    return group


def _output(nodes, shader, alpha):
    """The material's output node, with the shader let through by alpha (a socket, or nothing)."""
    if alpha is not None:
        through = nodes.new("ShaderNodeMixShader")
        nodes.put(alpha, through.inputs[0])
        nodes.put(nodes.new("ShaderNodeBsdfTransparent").outputs[0], through.inputs[1])
        nodes.put(shader, through.inputs[2])
        shader = through.outputs[0]
    output = nodes.new("ShaderNodeOutputMaterial")
    nodes.put(shader, output.inputs["Surface"])
    return output


def _principled(nodes, color, roughness, normal):
    node = nodes.new("ShaderNodeBsdfPrincipled")
    nodes.put(color, node.inputs["Base Color"])
    nodes.put(roughness, node.inputs["Roughness"])
    if normal is not None:
        nodes.put(normal, node.inputs["Normal"])
    return node.outputs[0]


def _coat(nodes, color, roughness, normal, gloss):
    """As the run's own pictures have it (render/material.h): a matt base below a clear film of index 1.45,
    the film only where the camera sees it first."""
    base, film, fresnel = (
        nodes.new("ShaderNodeBsdfDiffuse"),
        nodes.new("ShaderNodeBsdfGlossy"),
        nodes.new("ShaderNodeFresnel"),
    )
    nodes.put(color, base.inputs["Color"])
    nodes.put((1.0, 1.0, 1.0, 1.0), film.inputs["Color"])
    nodes.put(roughness, film.inputs["Roughness"])
    nodes.put(1.45, fresnel.inputs["IOR"])
    if normal is not None:
        for node in (base, film, fresnel):
            nodes.put(normal, node.inputs["Normal"])
    seen = nodes.math("MULTIPLY", nodes.new("ShaderNodeLightPath").outputs["Is Camera Ray"], gloss)
    mix = nodes.new("ShaderNodeMixShader")
    nodes.put(nodes.math("MULTIPLY", fresnel.outputs[0], seen), mix.inputs[0])
    nodes.put(base.outputs[0], mix.inputs[1])
    nodes.put(film.outputs[0], mix.inputs[2])
    return mix.outputs[0]


def make_material(liquid, run=None):
    """Makes the material of an imported run anew, from the settings of its panel. run: where what it says is
    not what is on the disk. Throws Problem if a picture is missing."""
    settings = liquid.fluidtex
    run = run or Run(settings.surfaces)
    if settings.exemplar:
        run.exemplar = bpy.path.abspath(settings.exemplar)
    render = run.scene.get("render") or {}
    names = ("color", "roughness", "normal", "bump", "displacement", "alpha")
    maps = {name: path for name in names if (path := getattr(settings, f"{name}_map"))}
    with_places = run.has_places() and not settings.by_points
    if maps and not with_places:
        raise Problem(
            f"{run.surfaces}: a map of {next(iter(maps))} needs places in the exemplar, which are not there "
            "or not used; untick Colours of the points, or let this version of fluidtex write the run again"
        )
    settings.problem = ""
    if with_places and not os.path.exists(run.exemplar):
        settings.problem = (
            f"{run.exemplar}: the run's exemplar is not there; name it in the panel. "
            "Colours of the points are shown"
        )
        with_places, maps = False, {}
    for name, path in maps.items():  # those that cannot be read leave the material as it is
        _load_image(path, name != "color")

    material = liquid.data.materials[0] if liquid.data.materials else None
    if material is None:
        material = bpy.data.materials.new(f"{liquid.name} texture")
        liquid.data.materials.append(material)
    material.use_nodes = True
    nodes = Nodes(material.node_tree)

    def group(made):
        return nodes.new("ShaderNodeGroup", node_tree=made)

    alpha = normal = None
    if with_places:
        shown = group(color_group(run, maps.get("color") or run.exemplar))
        color = shown.outputs["Color"]
        output_alpha = shown.node_tree.nodes["Group Output"].inputs["Alpha"]
        alpha = shown.outputs["Alpha"] if output_alpha.is_linked else None
    else:
        color = nodes.attribute("Col", "Color")
        alpha = nodes.attribute("Col", "Alpha")
    roughness = float(np.sqrt(render.get("roughness", 0.05)))  # ours is GGX's alpha
    if "roughness" in maps:
        roughness = group(value_group(run, maps["roughness"])).outputs["Value"]
    if "alpha" in maps:
        alpha = group(value_group(run, maps["alpha"])).outputs["Value"]
    if "normal" in maps:
        node = group(normal_group(run, maps["normal"]))
        nodes.put(settings.normal_strength, node.inputs["Strength"])
        normal = node.outputs["Normal"]
    if "bump" in maps:
        bump = nodes.new("ShaderNodeBump")
        nodes.put(group(value_group(run, maps["bump"])).outputs["Value"], bump.inputs["Height"])
        nodes.put(settings.bump_distance, bump.inputs["Distance"])
        if normal is not None:
            nodes.put(normal, bump.inputs["Normal"])
        normal = bump.outputs[0]

    if settings.shader == "EMISSION":
        node = nodes.new("ShaderNodeEmission")
        nodes.put(color, node.inputs["Color"])
        shader = node.outputs[0]
    elif settings.shader == "COAT":
        shader = _coat(nodes, color, roughness, normal, float(render.get("gloss", 1.0)))
    else:
        shader = _principled(nodes, color, roughness, normal)
    output = _output(nodes, shader, alpha)
    if "displacement" in maps:
        node = nodes.new("ShaderNodeDisplacement")
        nodes.put(group(value_group(run, maps["displacement"])).outputs["Value"], node.inputs["Height"])
        nodes.put(settings.displacement_scale, node.inputs["Scale"])
        nodes.put(node.outputs[0], output.inputs["Displacement"])
        # Of the material itself from 4.1 on.
        owner = material if hasattr(material, "displacement_method") else material.cycles
        owner.displacement_method = "BOTH"
    return material


# ---- the timeline ------------------------------------------------------------------------------------------


def _file_at(settings, scene):
    """The surface that a frame of the scene shows; None where it shows none."""
    folder = bpy.path.abspath(settings.surfaces)
    wanted = scene.frame_current - settings.start + 1
    file = os.path.join(folder, f"{wanted:04d}.ply")
    if wanted > 0 and os.path.exists(file):
        return file
    try:
        frames = sorted(int(name[:-4]) for name in os.listdir(folder) if re.fullmatch(r"\d+\.ply", name))
    except OSError:
        raise Problem(
            f"{folder}: is not there; name the folder with the surfaces in the panel of the liquid"
        ) from None
    if not frames or (settings.beyond == "EMPTY" and not frames[0] <= wanted <= frames[-1]):
        return None
    held = [frame for frame in frames if frame <= wanted] or frames[:1]
    return os.path.join(folder, f"{held[-1]:04d}.ply")


def show(liquid, scene, anew=False):
    """Fills the mesh of an imported run with the surface of the scene's frame, unless it is there already."""
    settings = liquid.fluidtex
    file = _file_at(settings, scene)
    rate = scene.render.fps / scene.render.fps_base
    # Cycles takes velocities as metres a second at the scene's rate; the liquid moves by frames, whatever
    # their rate is.
    factor = rate / settings.frame_rate if settings.frame_rate > 0 else 1.0
    loaded = "nothing"
    if file:
        status = os.stat(file)
        loaded = f"{file} {status.st_mtime_ns} {status.st_size} {factor} {settings.custom_normals}"
    if liquid.data.get("fluidtex") == loaded and not anew:
        return
    if file:
        fill(liquid.data, read_ply(file), factor, settings.custom_normals)
    else:
        liquid.data.clear_geometry()
    liquid.data["fluidtex"] = loaded


@persistent
def on_frame(scene, _depsgraph=None):
    # For motion blur Cycles visits moments between frames, several a picture: the mesh stays what it is then,
    # and its velocities say where it goes.
    if scene.frame_subframe != 0.0:
        return
    for liquid in scene.objects:
        if liquid.type == "MESH" and liquid.fluidtex.surfaces:
            try:
                show(liquid, scene)
                problem = ""
            except (Problem, OSError) as error:
                problem = str(error)
                print(f"fluidtex: {problem}")
            if liquid.fluidtex.problem != problem:
                liquid.fluidtex.problem = problem


def import_run(path, start=1, scene=None, name=None, **settings):
    """One object that shows a run's frames, linked into the scene. path: as Run, or a Run. start: the scene's
    frame that shows the run's frame 1. settings: those of FluidtexLiquid. Throws Problem."""
    run = path if isinstance(path, Run) else Run(path)
    scene = scene or bpy.context.scene
    name = name or run.scene.get("name") or os.path.basename(run.folder)
    mesh = bpy.data.meshes.new(name)
    liquid = bpy.data.objects.new(name, mesh)
    scene.collection.objects.link(liquid)
    # While a picture is rendered in the background, its frames replace the mesh that the window would draw.
    scene.render.use_lock_interface = True
    own = liquid.fluidtex
    own.surfaces = bpy.path.relpath(run.surfaces) if bpy.data.filepath else run.surfaces
    own.start, own.frame_rate = start, run.frame_rate
    if run.has_places():
        _take_relief(own, run)
    for key, value in settings.items():
        setattr(own, key, value)
    try:
        make_material(liquid, run)
        show(liquid, scene)
    except Problem as problem:
        bpy.data.objects.remove(liquid)
        bpy.data.meshes.remove(mesh)
        raise problem
    return liquid


def _take_relief(settings, run):
    """The relief that the run's own pictures have: render.bump, of one of its maps."""
    bump = (run.scene.get("render") or {}).get("bump") or {}
    for own in (run.scene.get("texture") or {}).get("map") or []:
        if own["name"] != bump.get("map") or not os.path.exists(own["file"]):
            continue
        if own.get("holds") == "normals":
            settings.normal_map, settings.normal_strength = own["file"], bump.get("height", 1.0)
        else:
            spacings = [spacing for spacing in run.spacing.values() if spacing]
            settings.bump_map = own["file"]
            settings.bump_distance = bump.get("height", 1.0) * (spacings[0] if spacings else 0.01)


# ---- texture on a liquid that is baked here ----------------------------------------------------------------


def program():
    """The fluidtex program: of the add-on's preferences, else of the variable FLUIDTEX, else of PATH."""
    addon = bpy.context.preferences.addons.get(__name__)
    chosen = addon.preferences.program if addon and addon.preferences else ""
    named = chosen or os.environ.get("FLUIDTEX", "")
    found = bpy.path.abspath(named) if named else shutil.which("fluidtex")
    if not found or not os.access(found, os.X_OK) or os.path.isdir(found):
        where = f"{found} is no program that can be started" if found else "the program fluidtex is not found"
        raise Problem(
            f"{where}; give its place in Preferences > Add-ons > fluidtex, "
            "for example build/release/fluidtex of its folder"
        )
    return os.path.abspath(found)


def _numbers(folder, pattern):
    try:
        return {
            int(found[1]) for found in (re.fullmatch(pattern, name) for name in os.listdir(folder)) if found
        }
    except OSError:
        return set()


def first_number(cache):
    """The frame of the scene that the first frame of a cache's run belongs to."""
    data = _numbers(os.path.join(cache, "data"), r"fluid_data_(\d+)\..*")
    meshes = _numbers(os.path.join(cache, "mesh"), r"(?:fluid_mesh|lMesh)_(\d+)\..*")
    baked = _numbers(os.path.join(cache, "bakefiles"), r"(\d+)\.bobj")
    return min((data & meshes) or data or baked, default=1)


def cache_of(domain):
    """Cache folder of a liquid's domain: Blender's own, or that of the add-on FLIP Fluids; None of any other
    object."""
    for modifier in domain.modifiers if domain else ():
        if (
            modifier.type == "FLUID"
            and modifier.fluid_type == "DOMAIN"
            and modifier.domain_settings.domain_type == "LIQUID"
        ):
            return os.path.normpath(bpy.path.abspath(modifier.domain_settings.cache_directory))
    flip = getattr(domain, "flip_fluid", None)
    if flip is not None and getattr(flip, "object_type", "") == "TYPE_DOMAIN":
        cache = flip.domain.cache
        folder = (
            cache.get_cache_abspath()
            if hasattr(cache, "get_cache_abspath")
            else bpy.path.abspath(cache.cache_directory)
        )
        return os.path.normpath(folder)
    return None


class Job:
    """`fluidtex texture` at work. frame, last: how far it is; 0 before the first. Ends by itself, or by
    stop()."""

    def __init__(
        self,
        cache,
        exemplar,
        out,
        quality="default",
        settings=(),
        frame_rate=None,
        frames="",
        resume=False,
        pictures=False,
    ):
        for path, what in ((cache, "cache"), (exemplar, "picture")):
            if not os.path.exists(path):
                raise Problem(f"{path}: there is no such {what}")
        command = [program(), "texture", cache, "--exemplar", exemplar, "--out", out, "--quality", quality]
        if frame_rate:
            command += ["--set", f"frame_rate={frame_rate:.17g}"]
        for setting in settings:
            command += ["--set", setting]
        if frames:
            command += ["--frames", frames]
        command += ["--resume"] * resume + ["--no-render"] * (not pictures)
        self.out, self.frame, self.last = out, 0, 0
        self.lines = deque(maxlen=100)
        self._process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
        )
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        atexit.register(self.stop)

    def _read(self):
        for line in self._process.stdout:
            self.lines.append(line.rstrip())
            found = re.match(r"frame (\d+)\s*/\s*(\d+)\b", line)
            if found:
                self.frame, self.last = int(found[1]), int(found[2])

    def running(self):
        return self._process.poll() is None

    def stop(self):
        """As Ctrl-C does: the frame in progress is given up, and what is there can be continued with
        resume."""
        if self.running():
            self._process.send_signal(signal.SIGINT)

    def wait(self):
        """The program's exit code, once it has ended and all that it said is read."""
        code = self._process.wait()
        self._reader.join()
        return code

    def status(self):
        return f"frame {self.frame} of {self.last}" if self.frame else "begins"

    def check(self):
        """After the end: throws Problem with the program's own sentence if it failed."""
        code = self.wait()
        if code in (130, -signal.SIGINT):
            raise Problem("stopped; Go on (resume) continues from the last frame")
        if code != 0:
            faults = [re.sub(r"^error: ", "", line) for line in self.lines if "error: " in line]
            sentence = "; ".join(faults) or f"ended with code {code}: {' '.join(list(self.lines)[-1:])}"
            raise Problem(f"fluidtex texture: {sentence}")


def texture(cache, exemplar, out, report=print, **settings):
    """Textures a cache and waits for it; settings as those of Job. Throws Problem."""
    job = Job(cache, exemplar, out, **settings)
    told = 0
    try:
        while job.running():
            job._reader.join(0.2)
            if job.frame != told:
                told = job.frame
                report(f"fluidtex: {job.status()}")
    except KeyboardInterrupt:
        job.stop()
        job.wait()
        raise
    job.check()


# ---- settings, operators, panels ---------------------------------------------------------------------------

_BEYOND = [
    ("HOLD", "Hold", "Before the first and after the last frame these stay"),
    ("EMPTY", "Empty", "Before the first and after the last frame there is no liquid"),
]
_SHADERS = [
    ("PRINCIPLED", "Principled", "Principled BSDF"),
    ("COAT", "As the run's pictures", "A matt base below a clear film, as fluidtex itself draws it"),
    ("EMISSION", "Emission", "The colours alone, without light"),
]
_QUALITIES = [
    ("preview", "Preview", "10,000 points"),
    ("default", "Default", "40,000 points"),
    ("final", "Final", "200,000 points"),
]


def _map(what):
    return StringProperty(
        name=what, subtype="FILE_PATH", description="A picture over the exemplar, of any size"
    )


class FluidtexLiquid(bpy.types.PropertyGroup):
    """Of the object that shows a run."""

    surfaces: StringProperty(
        name="Surfaces", subtype="DIR_PATH", description="Folder of the run's surfaces, NNNN.ply"
    )
    start: IntProperty(
        name="First frame", default=1, description="Frame of the scene that shows the run's frame 1"
    )
    frame_rate: FloatProperty(
        name="Frame rate", min=0.0, description="Of the run; velocities go by it. 0: that of the scene"
    )
    beyond: EnumProperty(name="Beyond", items=_BEYOND)
    custom_normals: BoolProperty(
        name="The run's normals", description="As custom normals; slow. Else those of the smooth mesh"
    )
    exemplar: StringProperty(
        name="Exemplar", subtype="FILE_PATH", description="Where the run's exemplar is no longer at its place"
    )
    shader: EnumProperty(name="Shader", items=_SHADERS)
    by_points: BoolProperty(
        name="Colours of the points",
        description="Shown instead of looking the exemplar up at every place; without maps",
    )
    color_map: _map("Colour")
    roughness_map: _map("Roughness")
    normal_map: _map("Normals")
    normal_strength: FloatProperty(name="Strength", default=1.0, soft_min=0.0, soft_max=4.0)
    bump_map: _map("Bump")
    bump_distance: FloatProperty(
        name="Height", default=0.01, subtype="DISTANCE", precision=4, description="Of white above black"
    )
    displacement_map: _map("Displacement")
    displacement_scale: FloatProperty(
        name="Height",
        default=0.01,
        subtype="DISTANCE",
        precision=4,
        description="Of white above black; middle grey stays in place",
    )
    alpha_map: _map("Alpha")
    problem: StringProperty(options={"SKIP_SAVE"})


class FluidtexTexture(bpy.types.PropertyGroup):
    """Of a liquid's domain: how it is to be textured."""

    exemplar: StringProperty(
        name="Picture", subtype="FILE_PATH", description="The example that the texture is made from"
    )
    out: StringProperty(
        name="Results",
        subtype="DIR_PATH",
        description="Folder for the results; empty: beside the .blend file",
    )
    quality: EnumProperty(name="Quality", items=_QUALITIES, default="preview")
    toroidal: BoolProperty(
        name="Edges meet", description="The picture's left edge continues at its right, its top at its bottom"
    )
    frames: StringProperty(name="Frames", description="First and last, as 1:24; empty: all")
    settings: StringProperty(
        name="More", description="Keys of a scene file, as texture.spacing=0.01 texture.coherence=0.75"
    )
    resume: BoolProperty(
        name="Go on", description="From where an earlier run of the same settings was stopped"
    )
    status: StringProperty(options={"SKIP_SAVE"})


def _job_of(domain):
    """What `fluidtex texture` is told about a domain."""
    cache, own, scene = cache_of(domain), domain.fluidtex_texture, bpy.context.scene
    if cache is None:
        raise Problem(
            f"{domain.name}: is no domain of a liquid; "
            "choose the object whose physics are Fluid, Domain, Liquid"
        )
    if not os.path.isdir(cache):
        raise Problem(f"{cache}: there is no such cache; bake data and mesh first")
    if not own.exemplar:
        raise Problem("a picture is missing; choose one that the texture is made from")
    out = own.out
    if not out:
        if not bpy.data.filepath:
            raise Problem("a folder for the results is missing; choose one, or save the .blend file first")
        out = f"//fluidtex_{bpy.path.clean_name(domain.name)}"
    settings = ["texture.toroidal=true"] * own.toroidal + shlex.split(own.settings)
    return Job(
        cache,
        bpy.path.abspath(own.exemplar),
        os.path.normpath(bpy.path.abspath(out)),
        own.quality,
        settings,
        scene.render.fps / scene.render.fps_base,
        own.frames,
        own.resume,
    )


def _take_result(domain, out):
    """Shows the run in place of the domain's own mesh; a liquid that shows it already is brought up to
    date."""
    surfaces = Run(out).surfaces
    start = first_number(cache_of(domain))
    for liquid in bpy.context.scene.objects:
        if (
            liquid.type == "MESH"
            and liquid.fluidtex.surfaces
            and bpy.path.abspath(liquid.fluidtex.surfaces) == surfaces
        ):
            make_material(liquid)
            show(liquid, bpy.context.scene, anew=True)
            break
    else:
        liquid = import_run(out, start, name=f"{domain.name} textured")
    domain.display_type = "BOUNDS"
    domain.hide_render = True
    return liquid


class FLUIDTEX_OT_import_run(bpy.types.Operator):
    """Show a run of fluidtex on the timeline: choose its folder, run.json or one of its surfaces"""

    bl_idname = "fluidtex.import_run"
    bl_label = "Import fluidtex run"
    bl_options = {"REGISTER", "UNDO"}
    filepath: StringProperty(subtype="FILE_PATH")
    filter_glob: StringProperty(default="*.ply;run.json", options={"HIDDEN"})
    start: IntProperty(
        name="First frame", default=1, description="Frame of the scene that shows the run's frame 1"
    )
    beyond: EnumProperty(name="Beyond", items=_BEYOND)
    shader: EnumProperty(name="Shader", items=_SHADERS)
    custom_normals: BoolProperty(name="The run's normals", description="As custom normals; slow")

    def invoke(self, context, _event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        try:
            liquid = import_run(
                self.filepath,
                self.start,
                context.scene,
                beyond=self.beyond,
                shader=self.shader,
                custom_normals=self.custom_normals,
            )
        except Problem as problem:
            self.report({"ERROR"}, str(problem))
            return {"CANCELLED"}
        if liquid.fluidtex.problem:
            self.report({"WARNING"}, liquid.fluidtex.problem)
        for other in context.selected_objects:
            other.select_set(False)
        if liquid.name in context.view_layer.objects:
            liquid.select_set(True)
            context.view_layer.objects.active = liquid
        return {"FINISHED"}


class FLUIDTEX_OT_material(bpy.types.Operator):
    """Make the liquid's material anew from the maps and the shader chosen here"""

    bl_idname = "fluidtex.material"
    bl_label = "Make material"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return (
            context.object is not None
            and context.object.type == "MESH"
            and bool(context.object.fluidtex.surfaces)
        )

    def execute(self, context):
        try:
            show(context.object, context.scene, anew=True)
            make_material(context.object)
            context.object.fluidtex.problem = ""
        except Problem as problem:
            self.report({"ERROR"}, str(problem))
            return {"CANCELLED"}
        return {"FINISHED"}


_jobs = {}  # name of the domain: Job


class FLUIDTEX_OT_texture(bpy.types.Operator):
    """Texture this baked liquid with a picture, and show the result in its place"""

    bl_idname = "fluidtex.texture"
    bl_label = "Texture this liquid"

    @classmethod
    def poll(cls, context):
        return (
            context.object is not None
            and context.object.name not in _jobs
            and cache_of(context.object) is not None
        )

    def invoke(self, context, _event):
        try:
            self._domain = context.object.name
            _jobs[self._domain] = _job_of(context.object)
        except (Problem, ValueError) as problem:
            self.report({"ERROR"}, str(problem))
            return {"CANCELLED"}
        context.object.fluidtex_texture.status = "begins"
        self._timer = context.window_manager.event_timer_add(0.5, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        job, domain = _jobs[self._domain], bpy.data.objects.get(self._domain)
        if domain is not None:
            domain.fluidtex_texture.status = job.status()
        for area in context.screen.areas if context.screen else ():
            if area.type == "PROPERTIES":
                area.tag_redraw()
        if job.running():
            return {"PASS_THROUGH"}
        context.window_manager.event_timer_remove(self._timer)
        del _jobs[self._domain]
        return self._finish(job, domain)

    def execute(self, context):
        """Without a window, or from a script: waits."""
        try:
            job = _job_of(context.object)
        except (Problem, ValueError) as problem:
            self.report({"ERROR"}, str(problem))
            return {"CANCELLED"}
        return self._finish(job, context.object)

    def _finish(self, job, domain):
        try:
            job.check()
            if domain is not None:
                _take_result(domain, job.out)
                domain.fluidtex_texture.status = "done"
        except Problem as problem:
            if domain is not None:
                domain.fluidtex_texture.status = str(problem)
            self.report({"ERROR"}, str(problem))
            return {"CANCELLED"}
        return {"FINISHED"}


class FLUIDTEX_OT_stop(bpy.types.Operator):
    """Stop texturing; Go on continues from the last frame"""

    bl_idname = "fluidtex.stop"
    bl_label = "Stop"

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.name in _jobs

    def execute(self, context):
        _jobs[context.object.name].stop()
        return {"FINISHED"}


class _PropertiesPanel:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"

    def show(self, own, names):
        """A row for each of these properties, its name to the left."""
        self.layout.use_property_split = True
        for name in names:
            self.layout.prop(own, name)


class FLUIDTEX_PT_liquid(_PropertiesPanel, bpy.types.Panel):
    bl_label = "fluidtex"
    bl_context = "object"

    @classmethod
    def poll(cls, context):
        return FLUIDTEX_OT_material.poll(context)

    def draw(self, context):
        own, layout = context.object.fluidtex, self.layout
        if own.problem:
            layout.label(text=own.problem, icon="ERROR")
        self.show(own, ("surfaces", "start", "frame_rate", "beyond", "custom_normals"))
        layout.separator()
        for names in (
            ("exemplar",),
            ("shader",),
            ("by_points",),
            ("color_map",),
            ("roughness_map",),
            ("normal_map", "normal_strength"),
            ("bump_map", "bump_distance"),
            ("displacement_map", "displacement_scale"),
            ("alpha_map",),
        ):
            self.show(own, names if getattr(own, names[0]) else names[:1])
        layout.operator("fluidtex.material")


class FLUIDTEX_PT_texture(_PropertiesPanel, bpy.types.Panel):
    bl_label = "Texture this liquid"
    bl_context = "physics"

    @classmethod
    def poll(cls, context):
        return context.object is not None and cache_of(context.object) is not None

    def draw(self, context):
        own, layout = context.object.fluidtex_texture, self.layout
        self.show(own, ("exemplar", "toroidal", "out", "quality", "frames", "settings", "resume"))
        if context.object.name in _jobs:
            layout.label(text=own.status, icon="TIME")
            layout.operator("fluidtex.stop", icon="CANCEL")
        else:
            if own.status:
                layout.label(text=own.status)
            layout.operator("fluidtex.texture", icon="TEXTURE")


class FluidtexPreferences(bpy.types.AddonPreferences):
    bl_idname = __name__
    program: StringProperty(
        name="Program",
        subtype="FILE_PATH",
        description="fluidtex; empty: that of the variable FLUIDTEX or of PATH",
    )

    def draw(self, _context):
        self.layout.prop(self, "program")


_CLASSES = (
    FluidtexLiquid,
    FluidtexTexture,
    FLUIDTEX_OT_import_run,
    FLUIDTEX_OT_material,
    FLUIDTEX_OT_texture,
    FLUIDTEX_OT_stop,
    FLUIDTEX_PT_liquid,
    FLUIDTEX_PT_texture,
    FluidtexPreferences,
)


def _menu(self, _context):
    self.layout.operator(FLUIDTEX_OT_import_run.bl_idname, text="fluidtex run")


def register():
    for each in _CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Object.fluidtex = PointerProperty(type=FluidtexLiquid)
    bpy.types.Object.fluidtex_texture = PointerProperty(type=FluidtexTexture)
    bpy.types.TOPBAR_MT_file_import.append(_menu)
    # Before the frame's objects are evaluated, so that they are with the new mesh.
    bpy.app.handlers.frame_change_pre.append(on_frame)


def unregister():
    for job in _jobs.values():
        job.stop()
    bpy.app.handlers.frame_change_pre.remove(on_frame)
    bpy.types.TOPBAR_MT_file_import.remove(_menu)
    del bpy.types.Object.fluidtex_texture
    del bpy.types.Object.fluidtex
    for each in reversed(_CLASSES):
        bpy.utils.unregister_class(each)


if __name__ == "__main__":
    register()
