"""A Slurm cluster of this one machine, of two nodes, in a folder of its own; for tests."""
import getpass
import os
import shutil
import signal
import socket
import subprocess
import time

_DAEMONS = ("munged", "slurmctld", "slurmd")
_PATH = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"  # where Debian has the daemons
NODES = ("one", "two")

_CONFIG = """ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CryptoType=crypto/munge
SlurmctldPort={controller_port}
SlurmctldPidFile={folder}/slurmctld.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmdLogFile={folder}/slurmd-%n.log
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
DependencyParameters=kill_invalid_depend
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0,sched_min_interval=0
KillWait=1
MinJobAge=300
ReturnToService=2
{nodes}
PartitionName=all Nodes={names} Default=YES MaxTime=INFINITE State=UP
"""


def missing():
    """What is not installed of it, as a sentence; empty if all is there."""
    lacking = [
        name for name in (*_DAEMONS, "sbatch", "scontrol", "squeue") if not shutil.which(name, path=_PATH)
    ]
    if not lacking:
        return ""
    return f"{', '.join(lacking)}: not installed: apt-get install --no-install-recommends slurm-wlm munge"


def _free_ports(count):
    held = [socket.socket() for _ in range(count)]
    for one in held:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in held]
    for one in held:
        one.close()
    return ports


def _read(process, name):
    """Strings of a file in /proc; none where the process is gone, or not ours."""
    try:
        with open(f"/proc/{process}/{name}", encoding="utf-8", errors="replace") as file:
            return file.read().split("\0")
    except OSError:
        return [""]


def processes():
    """(number, command line) of all."""
    return [(int(number), _read(number, "cmdline")) for number in os.listdir("/proc") if number.isdigit()]


class Cluster:
    """Started by `with`; its end stops all daemons and jobs. environment: for what speaks to it."""

    def __init__(self, folder):
        self.folder = folder
        self.environment = dict(os.environ, PATH=_PATH, SLURM_CONF=os.path.join(folder, "slurm.conf"))
        self._running, self._back = [], {}

    def __enter__(self):
        try:
            self._start()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        # Last started, first ended; slurmd takes its jobs along only if the controller says so.
        if self._running:
            subprocess.run(
                ["scancel", "--user", getpass.getuser(), "--signal=KILL"],
                env=self.environment,
                stderr=subprocess.DEVNULL,
            )
            subprocess.run(
                ["scancel", "--user", getpass.getuser()], env=self.environment, stderr=subprocess.DEVNULL
            )
        for process in reversed(self._running):
            process.send_signal(signal.SIGTERM)
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        self._running = []

    def lose(self, node, job):
        """As if the power went: the node's daemon and the processes of the job there are gone, without a word."""
        daemon = next(
            process for process in self._running if process.args[:4] == ("slurmd", "-D", "-N", node)
        )
        daemon.kill()
        daemon.wait()
        self._running.remove(daemon)
        steps = [number for number, words in processes() if words[0].startswith(f"slurmstepd: [{job}.")]
        for number in [
            *steps,
            *(number for number, _ in processes() if f"SLURM_JOB_ID={job}" in _read(number, "environ")),
        ]:
            os.kill(number, signal.SIGKILL)
        self.ask("scontrol", "update", f"NodeName={node}", "State=DOWN", "Reason=lost")

    def hasten(self):
        """Starts what was put back into the queue after three seconds instead of the two minutes that Slurm
        allows a machine to forget the job."""
        for line in self.ask("squeue", "--noheader", "--states=PENDING", "--format=%i %r").splitlines():
            job, reason = line.split(maxsplit=1)
            if reason == "BeginTime" and time.monotonic() > self._back.setdefault(job, time.monotonic()) + 3:
                self.ask("scontrol", "update", f"JobId={job}", "StartTime=now")

    def ask(self, *command):
        """Stdout of a command of Slurm."""
        return subprocess.run(
            command, env=self.environment, check=True, capture_output=True, text=True
        ).stdout

    def _daemon(self, *command):
        with open(os.path.join(self.folder, command[0] + ".out"), "ab") as log:
            self._running.append(
                subprocess.Popen(
                    command, env=self.environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log
                )
            )

    def _start(self):
        inside = lambda name: os.path.join(self.folder, name)
        for name in ("state", *(f"spool-{node}" for node in NODES)):
            os.makedirs(inside(name))
        with open(inside("munge.key"), "wb") as key:
            key.write(os.urandom(128))
        os.chmod(inside("munge.key"), 0o400)
        controller, *ports = _free_ports(1 + len(NODES))
        cores = max(1, (os.cpu_count() or 1) // len(NODES))
        host = socket.gethostname()
        with open(inside("slurm.conf"), "w", encoding="utf-8") as config:
            config.write(
                _CONFIG.format(
                    host=host,
                    user=getpass.getuser(),
                    folder=self.folder,
                    controller_port=controller,
                    names=",".join(NODES),
                    nodes="\n".join(
                        f"NodeName={name} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs={cores} State=UNKNOWN"
                        for name, port in zip(NODES, ports)
                    ),
                )
            )
        self._daemon(
            "munged",
            "--foreground",
            "--force",
            f"--socket={inside('munge.socket')}",
            f"--key-file={inside('munge.key')}",
            f"--log-file={inside('munge.log')}",
            f"--pid-file={inside('munge.pid')}",
            f"--seed-file={inside('munge.seed')}",
        )
        self._wait(lambda: os.path.exists(inside("munge.socket")), "munged")
        self._daemon("slurmctld", "-D", "-f", inside("slurm.conf"))
        for node in NODES:
            self._daemon("slurmd", "-D", "-N", node, "-f", inside("slurm.conf"))
        self._wait(self._is_idle, "slurm")

    def _is_idle(self):
        shown = subprocess.run(
            ["sinfo", "--noheader", "--Node", "--format=%T"],
            env=self.environment,
            capture_output=True,
            text=True,
        )
        return shown.returncode == 0 and shown.stdout.split() == ["idle"] * len(NODES)

    def _wait(self, is_so, what):
        end = time.monotonic() + 60
        while not is_so():
            if time.monotonic() > end or any(process.poll() is not None for process in self._running):
                raise RuntimeError(f"{what} did not start; see the logs in {self.folder}")
            time.sleep(0.1)
