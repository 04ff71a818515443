"""Hands jobs over to Slurm, and asks how far they are."""
import glob
import json
import os
import shutil
import subprocess

from jobs import script_of
from variants import Problem, file_name

_RECORD = "farm.json"  # in OUT/jobs: what was submitted


def submit(jobs, variants, given):
    """Raises Problem where Slurm refuses one; those before it are cancelled."""
    _require_slurm()
    folder = os.path.join(given.out, "jobs")
    if still := _queued(_record(given.out)["jobs"]):
        stop = f"scancel {' '.join(sorted(still))}"
        raise Problem(f"{given.out}: its jobs are still in the queue; wait for them, or stop them: {stop}")
    for name in {variant.name.split(os.sep)[0] for variant in variants}:
        results = os.path.join(given.out, name)
        if not given.resume and os.path.exists(results):
            raise Problem(f"{results}: is there already; --resume goes on with it, --out DIR begins elsewhere")
    os.makedirs(folder, exist_ok=True)
    ids = {}
    for job in jobs:
        script = os.path.join(folder, file_name(job.name) + ".sh")
        with open(script, "w", encoding="utf-8") as file:
            file.write(script_of(job, given))
        asked = subprocess.run(["sbatch", *options_of(job, given, ids), script], capture_output=True, text=True)
        if asked.returncode != 0:
            if ids:
                subprocess.run(["scancel", *ids.values()])
            raise Problem(f"sbatch refuses the job {job.name}: {asked.stderr.strip()}")
        ids[job.name] = asked.stdout.strip().split(";")[0]
    liquids = {job.name.removesuffix("/texture-1"): "".join(job.after) for job in jobs}
    shown = [{"name": variant.name, "frames": variant.frames, "liquid": liquids[variant.name]}
             for variant in variants]
    with open(os.path.join(folder, _RECORD), "w", encoding="utf-8") as file:
        json.dump({"jobs": ids, "variants": shown}, file, indent=1)
    return ids


def options_of(job, given, ids):
    """Of sbatch. ids: of the jobs before; their names stand for those that have none."""
    words = ["--parsable", "--requeue", "--output=/dev/null", f"--job-name={file_name(job.name)}",
             f"--cpus-per-task={given.cores}"]
    if job.tasks:
        words.append(f"--array=0-{job.tasks - 1}")
    if job.after:
        before = ":".join(ids.get(name, name) for name in job.after)
        words += ["--kill-on-invalid-dep=yes", f"--dependency=afterok:{before}"]
    return words + given.sbatch


def status(out):
    """A line for each variant, by the files that are there, and one for the jobs."""
    _require_slurm()
    record = _record(out)
    if not record["variants"]:
        raise Problem(f"{out}: nothing was submitted there; give the --out of tools/farm")
    queued = _queued(record["jobs"])
    lines = []
    for variant in record["variants"]:
        count = lambda folder, *pattern: len(
            glob.glob(os.path.join(glob.escape(os.path.join(out, folder)), *pattern)))
        parts = [f"simulated {count(variant['liquid'], 'frame_*.vdb')}"] if variant["liquid"] else []
        parts += [f"textured {count(variant['name'], 'surface', '[0-9]*.ply')}",
                  f"drawn {count(variant['name'], 'frames', '[0-9]*.png')}"]
        mine = [job for job in record["jobs"]
                if job.startswith(variant["name"] + os.sep) or job == variant["liquid"]]
        if count(variant["name"], "report.html"):
            state = "done"
        elif any(record["jobs"][job] in queued for job in mine):
            running = [job for job in mine if "RUNNING" in queued.get(record["jobs"][job], ())]
            state = "running " + ", ".join(os.path.basename(job) for job in running) if running else "waiting"
        else:
            state = f"stopped; see {os.path.join(out, 'jobs')}"
        lines.append(f"{variant['name']}: of {variant['frames']} frames {', '.join(parts)}; {state}")
    if queued:
        lines.append(f"to stop all: scancel {' '.join(sorted(queued, key=int))}")
    return lines


def _require_slurm():
    if not shutil.which("sbatch"):
        raise Problem("sbatch: is not installed here; this needs Slurm, on a machine where jobs can be submitted "
                      "(apt-get install slurm-client), or --dry-run, which prints the jobs")


def _record(out):
    try:
        with open(os.path.join(out, "jobs", _RECORD), encoding="utf-8") as file:
            return json.load(file)
    except FileNotFoundError:
        return {"jobs": {}, "variants": []}


def _queued(ids):
    """{id: states of its tasks} of those that are not done."""
    if not ids:
        return {}
    asked = subprocess.run(["squeue", "--noheader", "--array", "--format=%F %T"], capture_output=True, text=True)
    if asked.returncode != 0:
        raise Problem(f"squeue: {asked.stderr.strip()}")
    queued = {}
    for line in asked.stdout.splitlines():
        job, state = line.split()
        if job in ids.values():
            queued.setdefault(job, set()).add(state)
    return queued
