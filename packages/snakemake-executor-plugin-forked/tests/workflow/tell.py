import json
import os
import signal
import sys
import tempfile
from pathlib import Path

of_shells = ("_", "SHLVL", "OLDPWD", "PS1")  # bash drops PS1 where nobody types
links = {n: os.path.realpath(f"/proc/self/fd/{n}") for n in os.listdir("/proc/self/fd")}
surroundings = {
    "names": [__name__, __file__, len(sys.argv), os.path.dirname(sys.argv[0])],
    "given": [*snakemake.output, dict(snakemake.wildcards), snakemake.rule],  # noqa: F821
    "places": [os.getcwd(), tempfile.gettempdir(), os.umask(0), sys.stdin.read()],
    "path": [folder for folder in sys.path if "-runtime-cache" not in folder],
    "environment": {name: os.environ[name] for name in os.environ if name not in of_shells},
    "signals": [str(signal.getsignal(s)) for s in (signal.SIGTERM, signal.SIGCHLD)],
    "blocked": [int(number) for number in signal.pthread_sigmask(signal.SIG_BLOCK, [])],
    "files": sorted(n for n, to in links.items() if "/fd/" not in to and "/font" not in to),
}
held = sys.modules.get("held")
letters = held.FONT.read(4).decode() if held else ""
forked = b"server.py" in Path(f"/proc/{os.getppid()}/cmdline").read_bytes()
Path(snakemake.output[0]).write_text(json.dumps([surroundings, forked, letters]))  # noqa: F821
