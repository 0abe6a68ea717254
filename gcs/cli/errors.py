"""How commands end: 0 all well, 1 flown but something fell short, 2 bad input, 70 a fault of Skein's own,
130 interrupted, 143 terminated, 129 terminal closed."""

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager

FELL_SHORT = 1
BAD_INPUT = 2
FAULT = 70
"""EX_SOFTWARE of sysexits.h."""
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
    except Exception as error:
        print(_told(error), file=sys.stderr)
        raise SystemExit(FAULT) from None
    except KeyboardInterrupt:
        print("skein: interrupted", file=sys.stderr)
        raise SystemExit(INTERRUPTED) from None


def _told(error: Exception) -> str:
    """What is said of an error that nobody has foreseen."""
    from gcs.cli.verbosity import is_verbose

    if is_verbose():
        import traceback

        return "".join(traceback.format_exception(error)) + "skein: please report this"
    words = " ".join(str(error).split())
    return f"skein: {type(error).__name__}: {words}: a fault of Skein's; please report it, -v shows where it is"
