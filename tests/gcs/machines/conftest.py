"""Machines in network namespaces, joined by wires with delay and loss. Skipped where such cannot be made."""

import contextlib
import ctypes
import fcntl
import heapq
import os
import random
import selectors
import shutil
import struct
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import pytest

T = TypeVar("T")

CLONE_NEWNET = 0x40000000
TUNSETIFF, IFF_TUN, IFF_NO_PI = 0x400454CA, 0x0001, 0x1000
"""Of linux/if_tun.h."""


@dataclass(frozen=True)
class Machine:
    """A network namespace.

    Attributes:
        name: of the namespace.
        address: of this end of its wire.
    """

    name: str
    address: str

    def command(self, *command: object) -> list[str]:
        """What runs a command on this machine."""
        return ["ip", "netns", "exec", self.name, *map(str, command)]

    def here(self, do: Callable[[], T]) -> T:
        """Do something on this machine, in a thread of its own: sockets that are opened there stay there."""
        found: list[T] = []

        def enter() -> None:
            with Path(f"/run/netns/{self.name}").open() as namespace:
                assert ctypes.CDLL(None).setns(namespace.fileno(), CLONE_NEWNET) == 0
            found.append(do())

        thread = threading.Thread(target=enter)
        thread.start()
        thread.join()
        return found[0]


@dataclass(frozen=True)
class Place:
    """A machine in the middle, with a wire to each of the others.

    Attributes:
        addresses: of the middle's ends of the wires, one for each of the others.
    """

    middle: Machine
    others: tuple[Machine, ...]
    addresses: tuple[str, ...]


@pytest.fixture
def make_place() -> Iterator[Callable[[str, int, float, float], Place]]:
    """Makes machines around one, by the kind of wire ("netem" or "tun"), the number of the others, delay in seconds
    and loss of packets, each way."""
    with ExitStack() as stack:
        yield lambda kind, others, delay_s, loss: _place(stack, kind, others, delay_s, loss)


def _place(stack: ExitStack, kind: str, others: int, delay_s: float, loss: float) -> Place:
    names = [f"skein{os.getpid()}-{i}" for i in range(others + 1)]
    if shutil.which("ip") is None or shutil.which("tc") is None:
        pytest.skip("no ip and tc here")
    for name in names:
        if (made := _run("ip", "netns", "add", name)).returncode:
            pytest.skip(f"no network namespaces here: {made.stderr.strip()}")
        stack.callback(_run, "ip", "netns", "del", name)
        _must("ip", "-n", name, "link", "set", "lo", "up")
    wires = {"netem": _netem_wire, "tun": _tun_wire}
    machines, addresses = [], []
    for i, name in enumerate(names[1:], 1):
        wires[kind](stack, (names[0], f"w{i}"), (name, "w0"), delay_s, loss)
        ours, theirs = f"10.77.{i}.1", f"10.77.{i}.2"
        _must("ip", "-n", names[0], "addr", "add", ours, "peer", theirs, "dev", f"w{i}")
        _must("ip", "-n", name, "addr", "add", theirs, "peer", ours, "dev", "w0")
        _must("ip", "-n", names[0], "link", "set", f"w{i}", "up")
        _must("ip", "-n", name, "link", "set", "w0", "up")
        _must("ip", "-n", name, "route", "add", "default", "via", ours, "dev", "w0")
        machines.append(Machine(name, theirs))
        addresses.append(ours)
    return Place(Machine(names[0], addresses[0]), tuple(machines), tuple(addresses))


End = tuple[str, str]
"""Of a wire: namespace, and name of the device there."""


def _netem_wire(stack: ExitStack, one: End, other: End, delay_s: float, loss: float) -> None:
    """A wire whose delay and loss are the kernel's."""
    _must("ip", "-n", one[0], "link", "add", one[1], "type", "veth", "peer", "name", other[1], "netns", other[0])
    for name, device in (one, other):
        netem = ("netem", "delay", f"{1000.0 * delay_s:g}ms", "loss", f"{100.0 * loss:g}%")
        if (made := _run("tc", "-n", name, "qdisc", "add", "dev", device, "root", *netem)).returncode:
            pytest.skip(f"this kernel has no netem: {made.stderr.strip()}")


def _tun_wire(stack: ExitStack, one: End, other: End, delay_s: float, loss: float) -> None:
    """A wire whose delay and loss are a thread's, for kernels without netem."""
    ends = [stack.enter_context(_tun(*end)) for end in (one, other)]
    ending = os.pipe()
    carrier = threading.Thread(target=_carry, args=(ends, ending[0], delay_s, loss))
    carrier.start()

    def end() -> None:
        os.write(ending[1], b"!")
        carrier.join()
        for descriptor in ending:
            os.close(descriptor)

    stack.callback(end)


@contextmanager
def _tun(namespace: str, device: str) -> Iterator[int]:
    """A tun device in a namespace; gives its descriptor, with a packet a read or write."""
    made_here = f"sk{os.getpid()}{random.SystemRandom().randrange(100_000)}"
    request = struct.pack("16sH22x", made_here.encode(), IFF_TUN | IFF_NO_PI)
    try:
        descriptor = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    except OSError as error:
        pytest.skip(f"no tun devices here: {error.strerror}")
    try:
        try:
            fcntl.ioctl(descriptor, TUNSETIFF, request)
        except OSError as error:
            pytest.skip(f"no tun devices here: {error.strerror}")
        _must("ip", "link", "set", made_here, "netns", namespace, "name", device)
        yield descriptor
    finally:
        os.close(descriptor)


def _carry(ends: list[int], ending: int, delay_s: float, loss: float) -> None:
    """Carry packets between two ends until something can be read from `ending`; the same ones are lost each time."""
    draw = random.Random(7)
    on_the_way: list[tuple[float, int, int, bytes]] = []
    number = 0
    with selectors.DefaultSelector() as selector:
        for i in (0, 1):
            selector.register(ends[i], selectors.EVENT_READ, i)
        selector.register(ending, selectors.EVENT_READ, None)
        while True:
            due_in_s = max(0.0, on_the_way[0][0] - time.monotonic()) if on_the_way else None
            for key, _ in selector.select(due_in_s):
                if key.data is None:
                    return
                with contextlib.suppress(BlockingIOError):
                    packet = os.read(ends[key.data], 65536)
                    if draw.random() >= loss:
                        number += 1
                        arrival_s = time.monotonic() + delay_s
                        heapq.heappush(on_the_way, (arrival_s, number, ends[1 - key.data], packet))
            while on_the_way and on_the_way[0][0] <= time.monotonic():
                _, _, end, packet = heapq.heappop(on_the_way)
                with contextlib.suppress(OSError):  # the far end is not up yet, or no more
                    os.write(end, packet)


def _run(*command: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(command, capture_output=True, text=True)


def _must(*command: str) -> None:
    result: Any = _run(*command)
    assert result.returncode == 0, f"{' '.join(command)}: {result.stderr}"
