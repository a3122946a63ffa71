"""Has a job started by the process of workflow/warm.py, or starts it as Snakemake said.

`python -I -S ask_warm.py NAME COMMAND...` stands before the command of a job. It hands the job to
the process that listens at the abstract Unix socket NAME, waits for it, and ends as the job did.
Where nobody listens, or where that process does not take the job, this process becomes COMMAND.
This file runs once for each job, so it imports only what Python has compiled into itself.
"""

import _signal
import _socket
import marshal
import posix
import sys

SO_PEERCRED = getattr(_socket, "SO_PEERCRED", None)
PATIENCE = 1.0
"""Seconds that a job has to end after Ctrl-C, before it is told so once more."""


def main(name, command):
    """Hand the job over, or become its command."""
    connection = _asked(name, command)
    if connection is None:
        posix.execv(command[0], command)
    try:
        status = connection.recv(4)
    except KeyboardInterrupt:  # the job has heard it too, unless it came a moment too early
        _signal.signal(_signal.SIGINT, _signal.SIG_IGN)
        status = _after_interrupt(connection)
    posix._exit(int.from_bytes(status, "little") if status else 1)


def _asked(name, command):
    """Return the connection to the process that took the job, or None."""
    script = command[1] if len(command) == 2 else ""
    if "/.snakemake/scripts/" not in script:
        return None  # not a job of Python
    connection = _socket.socket(_socket.AF_UNIX, _socket.SOCK_STREAM)
    try:
        connection.connect("\0" + name)
        peer = connection.getsockopt(_socket.SOL_SOCKET, SO_PEERCRED, 12)
        if int.from_bytes(peer[4:8], sys.byteorder) != posix.getuid():
            return None  # another user's process shall not see the environment
        mask = posix.umask(0)
        posix.umask(mask)
        request = marshal.dumps((command, posix.getcwd(), mask, dict(posix.environ)))
        streams = b"".join(fd.to_bytes(4, sys.byteorder) for fd in (0, 1, 2))
        rights = [(_socket.SOL_SOCKET, _socket.SCM_RIGHTS, streams)]
        connection.sendmsg([len(request).to_bytes(4, "little")], rights)
        connection.sendall(request)
        return connection if connection.recv(1) else None
    except OSError:
        return None


def _after_interrupt(connection):
    connection.settimeout(PATIENCE)
    try:
        return connection.recv(4)
    except OSError:
        connection.shutdown(_socket.SHUT_WR)
        connection.settimeout(None)
        return connection.recv(4)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
