"""How commands end: 0 all well, 1 flown but something fell short, 2 bad input, 130 interrupted, 143 terminated,
129 terminal closed."""

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager

FELL_SHORT = 1
BAD_INPUT = 2
INTERRUPTED = 130
TERMINATED = 143
HUNG_UP = 129


@contextmanager
def exit_codes() -> Iterator[None]:
    """Turn what a user can mend into one line on standard error and an exit code."""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(TERMINATED))
    if hasattr(signal, "SIGHUP") and signal.getsignal(signal.SIGHUP) == signal.SIG_DFL:  # nohup ignores it
        signal.signal(signal.SIGHUP, lambda *_: sys.exit(HUNG_UP))
    from gcs.transfers.errors import TransferError
    from missions.errors import InputError

    try:
        yield
    except (InputError, TransferError) as error:
        print(f"skein: {error}", file=sys.stderr)
        raise SystemExit(BAD_INPUT) from None
    except OSError as error:
        where = f"{error.filename}: " if error.filename else ""
        print(f"skein: {where}{error.strerror or error}", file=sys.stderr)
        raise SystemExit(BAD_INPUT) from None
    except KeyboardInterrupt:
        print("skein: interrupted", file=sys.stderr)
        raise SystemExit(INTERRUPTED) from None
