"""A Slurm of its own on one machine: munged, slurmctld and slurmd with their files in one folder."""
import ctypes
import os
import shutil
import signal
import socket
import subprocess
import time

CONF = """ClusterName=local
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CryptoType=crypto/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
KillWait=5
SlurmctldPort={control}
SlurmdPort={node}
MpiDefault=none
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} RealMemory=4000 State=UNKNOWN
PartitionName=debug Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def die_with_parent():
    """A test that is killed leaves no daemon behind."""
    pr_set_pdeathsig = 1
    ctypes.CDLL(None).prctl(pr_set_pdeathsig, signal.SIGTERM)


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Slurm:
    """`why` says why it could not be started; None when it runs. `env`: the environment of its commands."""

    def __init__(self, folder):
        self.why = None
        self.started = []
        self.env = {**os.environ, "SLURM_CONF": os.path.join(folder, "slurm.conf")}
        missing = [name for name in ("munged", "slurmctld", "slurmd", "sbatch") if not self.path_of(name)]
        if missing:
            self.why = "not installed: " + ", ".join(missing)
        elif os.geteuid() != 0:
            self.why = "only root starts a Slurm"
        else:
            self.start(folder)

    @staticmethod
    def path_of(name):
        return shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin:/sbin")

    def start(self, folder):
        os.chmod(folder, 0o755)
        for name in ("state", "spool"):
            os.mkdir(os.path.join(folder, name))
        key = os.path.join(folder, "munge.key")
        with open(key, "wb") as file:
            file.write(os.urandom(1024))
        os.chmod(key, 0o400)
        host = socket.gethostname().split(".")[0]
        with open(self.env["SLURM_CONF"], "w", encoding="utf-8") as file:
            file.write(CONF.format(host=host, folder=folder, control=free_port(), node=free_port(), cores=os.cpu_count()))
        munge = ["--force", "--foreground", "--key-file=" + key] + [
            f"--{what}={folder}/munge.{ending}" for what, ending in
            (("socket", "socket"), ("log-file", "log"), ("pid-file", "pid"), ("seed-file", "seed"))]
        for name, words in (("munged", munge), ("slurmctld", ["-D"]), ("slurmd", ["-D", "-N", host])):
            with open(os.path.join(folder, name + ".out"), "w", encoding="utf-8") as out:
                self.started.append(subprocess.Popen([self.path_of(name), *words], env=self.env, stdout=out, stderr=out,
                                                     start_new_session=True, preexec_fn=die_with_parent))
            time.sleep(0.5)
        for _ in range(40):
            found = subprocess.run(["sinfo", "-h", "-o", "%T"], env=self.env, capture_output=True, text=True, check=False)
            if found.stdout.strip() in ("idle", "mixed", "allocated"):
                return
            if any(one.poll() is not None for one in self.started):
                break
            time.sleep(0.5)
        logs = [os.path.join(folder, name) for name in ("munged.out", "slurmctld.log", "slurmd.log")]
        last = [open(log, encoding="utf-8", errors="replace").read().strip().split("\n")[-1] for log in logs if os.path.exists(log)]
        self.why = "Slurm does not start here: " + found.stdout.strip() + found.stderr.strip() + " | " + " | ".join(last)
        self.stop()

    def stop(self):
        if not self.why:
            subprocess.run(["scancel", "--user=root"], env=self.env, check=False)
            time.sleep(1)
        for one in reversed(self.started):
            if one.poll() is None:
                one.terminate()
        for one in reversed(self.started):
            try:
                one.wait(10)
            except subprocess.TimeoutExpired:
                one.kill()
                one.wait()
        self.started = []
