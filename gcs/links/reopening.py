"""Coming back after a connection was lost: soon at first, then less and less often."""

import asyncio
from collections.abc import Awaitable, Callable

FIRST_WAIT_S = 0.2
LONGEST_WAIT_S = 5.0


async def reopen(attempt: Callable[[], Awaitable[None]]) -> None:
    """Call `attempt` until it raises no OSError, each time after twice the wait of the time before."""
    wait_s = FIRST_WAIT_S
    while True:
        await asyncio.sleep(wait_s)
        try:
            await attempt()
        except OSError:
            wait_s = min(2.0 * wait_s, LONGEST_WAIT_S)
        else:
            return
