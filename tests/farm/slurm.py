# SPDX-License-Identifier: MIT
"""The check `slurm`: a Slurm of its own, of two nodes on this machine, one of which is killed while it bakes. It needs root."""

import contextlib
import os
import pathlib
import pwd
import re
import signal
import socket
import subprocess
import time

from common import FARM, SHARES, Skip, call, compare, environment, make_scene, need, single, until


def processes():
    """Yields the number, environment and words of all processes, as far as they may be read."""
    for entry in pathlib.Path("/proc").iterdir():
        if entry.name.isdigit():
            with contextlib.suppress(OSError):
                yield int(entry.name), (entry / "environ").read_bytes(), (entry / "cmdline").read_bytes()


def end(numbers):
    """Ends processes that this test has started, or that these have."""
    for number in numbers:
        with contextlib.suppress(ProcessLookupError):
            os.kill(number, signal.SIGKILL)


def free_ports(count):
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]


# What Slurm says of a slurm.conf that is wrong. All else that keeps daemons from starting is the machine's: its kernel, its
# names, its load.
OUR_FAULT = re.compile("[Pp]ars|[Ii]nvalid|unrecognized|slurm.conf")


class Slurm:
    """A cluster of two nodes on this machine, with keys, ports and files of its own, and no systemd."""

    NODES = ("n1", "n2")

    def __init__(self, folder, goffer):
        self.folder = folder
        self.daemons = []
        self.nodes = {}
        self.mark = f"GOFFER_FARM={folder}".encode()
        self.env = environment(goffer, {"SLURM_CONF": str(folder / "slurm.conf"), "GOFFER_FARM": str(folder)})

    def __enter__(self):
        try:
            self.start_munge()
            self.configure()
            self.start("slurmctld", ["slurmctld", "-D", "-c"])
            until(lambda: self.answers("UP"), "slurmctld", 60)
            for node in self.NODES:
                self.nodes[node] = self.start(node, ["slurmd", "-D", "-N", node])
            until(lambda: self.states().count("idle") == len(self.NODES), "nodes that are idle", 60)
        except AssertionError as fault:
            self.__exit__(None, None, None)
            said = self.said()
            if any(OUR_FAULT.search(line) for line in said):
                raise AssertionError("\n".join([str(fault), *said])) from fault
            raise Skip("Slurm does not start here: " + "; ".join([str(fault), *said][:3])) from fault
        except PermissionError as fault:
            self.__exit__(None, None, None)
            raise Skip(f"Slurm does not start here: {fault}") from fault
        except BaseException:
            self.__exit__(None, None, None)
            raise
        return self

    def __exit__(self, *_):
        """All that bears the mark, which jobs and their steps inherit, whatever became of their parents."""
        for _ in range(3):
            end([number for number, env, _ in processes() if self.mark in env and number != os.getpid()])
            time.sleep(0.2)
        for daemon in self.daemons:
            daemon.wait()

    def start(self, name, words, **more):
        log = open(self.folder / f"{name}.out", "wb")
        daemon = subprocess.Popen(words, env=self.env, stdout=log, stderr=log, start_new_session=True, **more)
        self.daemons.append(daemon)
        return daemon

    def said(self):
        """What the daemons complain of."""
        lines = [line for log in sorted(self.folder.glob("*.out")) for line in log.read_text(errors="replace").splitlines()]
        return [line for line in lines if re.search(r"\b(error|fatal)\b", line, re.IGNORECASE)]

    def start_munge(self):
        user = pwd.getpwnam("munge")
        place = self.folder / "munge"
        place.mkdir(mode=0o755)
        (place / "key").write_bytes(os.urandom(128))
        (place / "key").chmod(0o600)
        for path in (place, place / "key"):
            os.chown(path, user.pw_uid, user.pw_gid)
        files_of = {"socket": "socket", "key-file": "key", "log-file": "log", "pid-file": "pid", "seed-file": "seed"}
        words = ["munged", "--foreground", *(f"--{option}={place / name}" for option, name in files_of.items())]
        self.start("munged", words, user=user.pw_uid, group=user.pw_gid, extra_groups=[])
        until(lambda: (place / "socket").exists(), "munged", 30)

    def configure(self):
        host = socket.gethostname().split(".")[0]
        control, *ports = free_ports(1 + len(self.NODES))
        lines = f"""
            ClusterName=farm
            SlurmctldHost={host}(127.0.0.1)
            SlurmctldPort={control}
            SlurmUser=root
            SlurmdUser=root
            AuthType=auth/munge
            AuthInfo=socket={self.folder}/munge/socket
            StateSaveLocation={self.folder}/state
            SlurmdSpoolDir={self.folder}/spool-%n
            SlurmctldPidFile={self.folder}/slurmctld.pid
            SlurmdPidFile={self.folder}/slurmd-%n.pid
            ProctrackType=proctrack/linuxproc
            TaskPlugin=task/none
            SwitchType=switch/none
            MpiDefault=none
            JobAcctGatherType=jobacct_gather/none
            AccountingStorageType=accounting_storage/none
            SelectType=select/cons_tres
            SelectTypeParameters=CR_CPU
            SchedulerParameters=sched_interval=2,batch_sched_delay=0,sched_min_interval=100000
            SlurmdTimeout=10
            KillWait=5
            ReturnToService=2
            JobRequeue=1
        """
        conf = "\n".join(line.strip() for line in lines.splitlines())
        for node, port in zip(self.NODES, ports):
            conf += f"NodeName={node} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs=1 State=UNKNOWN\n"
            (self.folder / f"spool-{node}").mkdir()
        conf += f"PartitionName=all Nodes={','.join(self.NODES)} Default=YES MaxTime=INFINITE State=UP\n"
        (self.folder / "state").mkdir()
        (self.folder / "slurm.conf").write_text(conf)

    def answers(self, word):
        done = subprocess.run(["scontrol", "ping"], env=self.env, capture_output=True, text=True)
        return word in done.stdout

    def states(self):
        done = subprocess.run(["sinfo", "-h", "-N", "-o", "%T"], env=self.env, capture_output=True, text=True)
        return done.stdout.split()

    def of_node(self, node):
        """Its jobs' processes, and those that started them."""
        name = f"SLURMD_NODENAME={node}".encode()
        found = [number for number, env, _ in processes() if self.mark in env and name in env]
        steps = [number for number, env, words in processes() if self.mark in env and words.startswith(b"slurmstepd")]
        jobs = set(found)
        parents = {parent_of(number) for number in found}
        return [number for number in steps if number in parents] + sorted(jobs)

    def bakes(self, node, cache):
        """A process of the node that is in the middle of a shard."""
        for number, env, words in processes():
            if self.mark in env and f"SLURMD_NODENAME={node}".encode() in env and b"--shard" in words:
                if list(cache.glob(f".goffer-{number}-*.part")):
                    return number
        return None

    def kill_node(self, node, cache):
        """As if its power went: what it is writing, whose names it returns, stays as it is."""
        torn = until(lambda: self.stopped_in_a_shard(node, cache), f"{node} bakes", 120)
        end([self.nodes[node].pid, *self.of_node(node)])
        return torn

    def stopped_in_a_shard(self, node, cache):
        """Stops a run of the node that is writing; the unfinished files, which other runs remove once it is gone."""
        number = self.bakes(node, cache)
        if not number:
            return None
        with contextlib.suppress(ProcessLookupError):
            os.kill(number, signal.SIGSTOP)
            torn = [path.name for path in cache.glob(f".goffer-{number}-*.part")]
            if torn:
                return torn
            os.kill(number, signal.SIGCONT)
        return None

    def ended(self, job):
        words = ["squeue", "-h", "-j", job, "-t", "all", "-o", "%T"]
        done = subprocess.run(words, env=self.env, capture_output=True, text=True)
        states = set(done.stdout.split())
        return states if states and not states & {"PENDING", "RUNNING", "COMPLETING", "CONFIGURING", "REQUEUED"} else None


def parent_of(number):
    with contextlib.suppress(OSError, IndexError):
        return int(pathlib.Path(f"/proc/{number}/stat").read_text().rsplit(")", 1)[1].split()[1])
    return 0


def slurm(goffer, folder):
    """An array of jobs on two nodes, one of which is killed in the middle of a shard."""
    if os.geteuid() != 0:
        raise Skip("only root can start daemons that run jobs of their own")
    need("munged", "slurmctld", "slurmd", "sbatch")
    folder.chmod(0o755)  # munged's user goes through it
    env = environment(goffer)
    scene = make_scene(folder, env)
    wanted = single(scene, folder / "single", env)
    cache = folder / "cache"
    with Slurm(folder, goffer) as cluster:
        start = time.monotonic()
        words = ["bash", FARM / "bake.sh", scene, cache, SHARES, "--shard-frames", "10"]
        array, finish = call(words, cluster.env).split()
        until(lambda: len(list(cache.glob("shard-*"))) >= SHARES // 2, "a quarter of the shards", 120)
        torn = cluster.kill_node("n2", cache)
        print(f"slurm: node n2 killed after {time.monotonic() - start:.1f} s, with {len(list(cache.glob('shard-*')))} "
              f"shards there and {', '.join(torn)} torn")
        states = until(lambda: cluster.ended(finish), "the last job", 480)
        log = (folder / "cache.logs/finish.log").read_text()
        assert states == {"COMPLETED"}, f"{states}\n{log}"
        restarted = call(["scontrol", "show", "job", array], cluster.env).count("Restarts=1")
        print(f"slurm: {SHARES} shares and the manifest in {time.monotonic() - start:.1f} s, {restarted} of them run again")
        assert restarted >= 1, "no share was run again"
        assert "verified" in log, log
    compare(cache, wanted)
    call(["goffer", "cache", "--verify", cache], env)
    left = [words for _, env, words in processes() if cluster.mark in env]
    assert not left, f"{left} still run"
