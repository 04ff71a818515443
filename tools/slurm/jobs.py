"""The jobs of tools/farm, and their scripts: each can be started again at any moment, and then goes on."""
import json
import math
import os
import shlex
from dataclasses import dataclass, field

from variants import file_name, unique

_SHEET_MOMENTS, _SHEET_COLUMNS, _SHEET_WIDTH = 3, 6, 480
_TIMES_AGAIN = 3  # that a job whose program was killed is started again


@dataclass
class Job:
    name: str
    commands: list  # of bash, each after the one before has succeeded
    after: list = field(default_factory=list)  # names of jobs that must have succeeded
    tasks: int = 0  # of an array; 0: no array


def wanted_jobs(variants, given):
    """In an order in which each comes after those that it waits for."""
    jobs, liquids, names = [], {}, set()
    for variant in variants:
        if variant.liquid and variant.liquid not in liquids:
            name = unique(os.path.join(variant.name.split(os.sep)[0], "liquid"), names)
            liquids[variant.liquid] = _liquid_job(name, variant, given)
            jobs.append(liquids[variant.liquid])
        chain = _texture_jobs(variant, given, liquids.get(variant.liquid))
        jobs += [*chain, *_picture_jobs(variant, given, chain[-1])]
    if len(variants) > 1:
        finished = [job.name for job in jobs if job.name.endswith("/finish")]
        jobs.append(_sheet_job(variants, given, finished))
    return jobs


def script_of(job, given):
    """Its words go to OUT/jobs/, where every start adds to them."""
    log = os.path.join(given.out, "jobs", file_name(job.name))
    task = ".$SLURM_ARRAY_TASK_ID" if job.tasks else ""
    return "\n".join([
        "#!/bin/bash",
        f"# {job.name}",
        f"exec >>{shlex.quote(log)}{task}.log 2>&1",
        'echo "--- $(date), $SLURMD_NODENAME, job $SLURM_JOB_ID, start $((${SLURM_RESTART_COUNT:-0} + 1))"',
        f"cd {shlex.quote(os.getcwd())} || exit 1",
        "work() {",
        "  " + " &&\n  ".join(job.commands),
        "}",
        "work",
        "code=$?",
        "# Above 128 the program was killed.",
        f"if [ $code -gt 128 ] && [ ${{SLURM_RESTART_COUNT:-0}} -lt {_TIMES_AGAIN} ]; then",
        "  scontrol requeue $SLURM_JOB_ID",
        "fi",
        "exit $code", ""])


def _command(*words):
    """Words that begin with $ are bash's."""
    return " ".join(word if word.startswith("$") else shlex.quote(word) for word in words)


_THREADS = ("--threads", "${SLURM_CPUS_PER_TASK:-1}")


def _liquid_job(name, variant, given):
    scene, *arguments = variant.liquid
    words = [given.program, "simulate", scene, *arguments, "--cache", os.path.join(given.out, name)]
    return Job(name, [_command(*words, "--resume", *_THREADS)])


def _texture_jobs(variant, given, liquid):
    """The chain: each goes on from the state that the one before has left."""
    words = [given.program, "run", variant.scene, *variant.arguments]
    if liquid:
        folder = json.dumps(os.path.join(given.out, liquid.name), ensure_ascii=False)
        words += ["--set", "motion.flow=files", "--set", f"files.path={folder}"]
    words += ["--out", os.path.join(given.out, variant.name)]
    words += ["--no-render", "--no-report", "--resume", *_THREADS]
    chain, after = [], [liquid.name] if liquid else []
    for last in [*range(given.link, variant.frames, given.link), variant.frames]:
        name = f"{variant.name}/texture-{len(chain) + 1}"
        chain.append(Job(name, [_command(*words, "--frames", f"1:{last}")], after))
        after = [chain[-1].name]
    return chain


def _picture_jobs(variant, given, textured):
    """An array that draws, and what makes video and page of its pictures."""
    folder, last = os.path.join(given.out, variant.name), f"first + {given.chunk - 1}"
    frames = [f"first=$((1 + SLURM_ARRAY_TASK_ID * {given.chunk}))",
              f"last=$(({last} < {variant.frames} ? {last} : {variant.frames}))"]
    render = [given.program, "render", variant.scene, *variant.arguments]
    render += ["--from", folder, "--out", folder, "--missing", *["--cycles"] * given.cycles, *_THREADS]
    frames.append(_command(*render, "--part", "--frames", "$first:$last"))
    array = Job(f"{variant.name}/draw", frames, [textured.name], math.ceil(variant.frames / given.chunk))
    return [array, Job(f"{variant.name}/finish", [_command(*render)], [array.name])]


def _sheet_job(variants, given, after):
    """A row a moment, the last one included, and a column a variant; of many variants the last moment alone."""
    few = len(variants) <= _SHEET_COLUMNS
    moments, columns = (_SHEET_MOMENTS, len(variants)) if few else (1, math.ceil(math.sqrt(len(variants))))
    pictures = []
    for moment in range(1, moments + 1):
        for variant in variants:
            frame = max(1, variant.frames * moment // moments)
            pictures += [picture_of(variant, frame, given), f"{variant.label}, {frame}"]
    # As tools/sheet/main.cpp reads it.
    fields = [os.path.join(given.out, "sheet.jpg"), columns, _SHEET_WIDTH, len(pictures) // 2, *pictures]
    drawer = os.path.join(os.path.dirname(given.program), "fluidtex_sheet")
    return Job("sheet", [f"printf '%s\\0' {_command(*map(str, fields))} | {_command(drawer)}"], after)


def picture_of(variant, frame, given):
    return os.path.join(given.out, variant.name, "frames", f"{frame:04d}.png")
