"""A lock that a process holds on a file."""

import sys
from typing import BinaryIO

FAR = 0x7FFF_0000
"""Windows locks bytes, and nobody else can read those: one where no content stands."""

if sys.platform != "win32":
    import fcntl

    def lock(file: BinaryIO) -> bool:
        """Keep an open file for this process alone; whether it was free. The lock goes with the file's closing, or with
        the process."""
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True

else:
    import msvcrt

    def lock(file: BinaryIO) -> bool:
        """As above."""
        file.seek(FAR)
        try:
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        except OSError:
            return False
        return True
