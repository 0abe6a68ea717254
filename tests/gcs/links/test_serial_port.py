"""What is true of serial links, with a pair of pseudo terminals for a cable."""

import asyncio
import contextlib
import os
import sys
import tty
from pathlib import Path
from typing import Any

import pytest

from gcs.links.serial_port import SerialLink
from missions.errors import InputError


def cable(end: Path) -> int:
    """The far end of a cable whose near end is the device `end`."""
    far, near = os.openpty()
    tty.setraw(near)
    end.unlink(missing_ok=True)
    end.symlink_to(os.ttyname(near))
    os.close(near)
    return far


def test_bytes_go_both_ways_and_a_lost_device_is_opened_again(listen: Any, tmp_path: Path) -> None:
    async def main() -> None:
        device = tmp_path / "radio"
        far = cable(device)
        link = await SerialLink.open(str(device), 57600)
        heard = listen(link)
        frame = bytes(range(256))
        os.write(far, frame)
        await heard.until(lambda: heard.received.get(link.peer) == frame)
        link.send(frame, link.greeted[0])
        assert os.read(far, 1000) == frame

        device.unlink()
        os.close(far)
        await heard.until(lambda: heard.news == [("lost", link.peer)])
        link.send(b"into the void", link.peer)
        far = cable(device)
        await heard.until(lambda: ("back", link.peer) in heard.news)
        os.write(far, b"again")
        await heard.until(lambda: heard.received[link.peer] == frame + b"again")
        await link.close()
        os.close(far)

    asyncio.run(main())


def test_what_the_port_does_not_take_waits_and_is_bounded(listen: Any, tmp_path: Path) -> None:
    async def main() -> None:
        device = tmp_path / "radio"
        far = cable(device)
        link = await SerialLink.open(str(device), 57600)
        frames = [number.to_bytes(4, "big") * 64 for number in range(1000)]
        for frame in frames:
            link.send(frame, link.peer)
        os.set_blocking(far, False)
        got, changed = bytearray(), asyncio.Event()

        def read() -> None:
            with contextlib.suppress(BlockingIOError):
                got.extend(os.read(far, 65536))
            changed.set()

        asyncio.get_running_loop().add_reader(far, read)
        async with asyncio.timeout(10.0):
            while link._backlog:
                await changed.wait()
                changed.clear()
            link.send(b"end", link.peer)
            while not got.endswith(b"end"):
                changed.clear()
                await changed.wait()
        asyncio.get_running_loop().remove_reader(far)
        assert got.startswith(b"".join(frames[:40]))
        assert len(got) % 256 == len(b"end")  # whole frames only
        assert len(got) < 256 * len(frames)
        await link.close()
        os.close(far)

    asyncio.run(main())


def test_a_device_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"serial .*/nothing:57600: .*No such file.*check the device"):
        asyncio.run(SerialLink.open(str(tmp_path / "nothing"), 57600))


def test_without_pyserial_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "serial", None)
    with pytest.raises(InputError, match=r"pip install 'skein-gcs\[serial\]'"):
        asyncio.run(SerialLink.open("/dev/ttyUSB0", 57600))
