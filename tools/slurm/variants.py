"""What tools/farm makes: for every scene its variants, one for each combination of the wedges' values."""
import itertools
import os
import re
import subprocess
import sys
import tomllib
from dataclasses import dataclass


class Problem(Exception):
    """A sentence for the user."""


@dataclass
class Variant:
    scene: str  # a scene file, or a cache of another program
    settings: tuple  # (key, value) of each wedge
    label: str  # for people
    name: str  # its folder in OUT, and what its jobs are called by
    arguments: list  # of fluidtex, behind the scene
    liquid: tuple = ()  # scene and arguments of `fluidtex simulate`; none where nothing is to be solved
    frames: int = 0


# Keys that change nothing of the liquid.
_NOT_OF_THE_LIQUID = ("exemplar", "texture.", "camera.", "light.", "render.")


def values_of(text):
    """What stands between commas, those in brackets and quotes left out."""
    parts = re.findall(r"""(?:\[[^\]]*\]|"[^"]*"|'[^']*'|[^,\[\]"'])+""", text)
    return [part.strip() for part in parts if part.strip()]


def wedge(text):
    """[(key, value), ...] of KEY=V1,V2."""
    key, _, values = text.partition("=")
    if not key or not values_of(values):
        raise Problem(
            f"--wedge {text}: is no key with values; give KEY=VALUE,VALUE, such as texture.points=20000,40000"
        )
    key = key.strip()
    if key not in ("exemplar", "texture.exemplar"):
        return [(key, value) for value in values_of(values)]
    return [("exemplar", os.path.abspath(value.strip("\"'"))) for value in values_of(values)]


def file_name(text):
    """A name that any desktop takes."""
    return re.sub(r"[^\w.-]+", "-", text).strip("-.") or "scene"


def unique(name, taken):
    """The name, or where it is taken already one with a number behind it. Takes it."""
    names = itertools.chain([name], (f"{name}-{count}" for count in itertools.count(2)))
    found = next(candidate for candidate in names if candidate not in taken)
    taken.add(found)
    return found


def wanted_variants(given):
    """given: the command line. Each is checked by `fluidtex check` first. Raises Problem."""
    combinations = list(itertools.product(*map(wedge, given.wedge)))
    variants, scene_names = [], {"jobs"}  # a folder beside theirs
    for scene in given.scenes:
        path = os.path.abspath(scene)
        scene_name, names = (
            unique(file_name(os.path.basename(path).removesuffix(".toml")), scene_names),
            set(),
        )
        for settings in combinations:
            label = ", ".join(_label(*setting) for setting in settings)
            name = os.path.join(scene_name, unique(file_name(label), names)) if settings else scene_name
            variant = Variant(path, settings, label or scene_name, name, _arguments(given, settings))
            if settings and len(given.scenes) > 1:
                variant.label = f"{scene_name}, {label}"
            if _is_simulated(path, given):
                of_liquid = [setting for setting in settings if not setting[0].startswith(_NOT_OF_THE_LIQUID)]
                variant.liquid = (path, *_arguments(given, of_liquid, exemplar=False))
            variant.frames = _frames(variant, given)
            variants.append(variant)
    return variants


def _label(key, value):
    shown = os.path.splitext(os.path.basename(value))[0] if key == "exemplar" else value
    return f"{key.rpartition('.')[2]} {shown}"


def _arguments(given, settings, exemplar=True):
    words = ["--quality", given.quality] if given.quality else []
    picture = dict(settings).get("exemplar", given.exemplar)
    if exemplar and picture:
        words += ["--exemplar", os.path.abspath(picture)]
    for setting in [*given.set, *(f"{key}={value}" for key, value in settings if key != "exemplar")]:
        words += ["--set", setting]
    return words


def _is_simulated(scene, given):
    """Whether the solver moves the liquid: it neither comes out of files nor is known in closed form."""
    if not scene.endswith(".toml"):
        return False
    flow = "solver"
    try:
        with open(scene, "rb") as file:
            flow = tomllib.load(file).get("motion", {}).get("flow", flow)
    except (OSError, tomllib.TOMLDecodeError):
        pass  # fluidtex check says what is wrong with it
    for setting in given.set:
        key, _, value = setting.partition("=")
        flow = value.strip(" \"'") if key.strip() == "motion.flow" else flow
    return flow == "solver"


def _frames(variant, given):
    checked = subprocess.run(
        [given.program, "check", variant.scene, *variant.arguments], capture_output=True, text=True
    )
    if checked.returncode != 0:
        raise Problem(checked.stderr.strip().removeprefix("error: "))
    sys.stderr.write(checked.stderr)
    return int(re.search(r"^frames +1 to (\d+) of", checked.stdout, re.MULTILINE)[1])
