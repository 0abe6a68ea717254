"""What is remembered of stations: a bounded number of them, for any number may call."""

from typing import Generic, TypeVar

from sitl.services.peer import Peer, Station

Value = TypeVar("Value")

MAX_STATIONS = 64


class StationMemory(Generic[Value]):
    """One value for each of the stations that were remembered last."""

    def __init__(self) -> None:
        self._values: dict[Station, Value] = {}

    def __len__(self) -> int:
        return len(self._values)

    def get(self, station: Station) -> Value | None:
        """What is remembered of a station, if anything."""
        return self._values.get(station)

    def put(self, station: Station, value: Value) -> None:
        """Remember something; the one remembered longest ago is forgotten for it when there are too many."""
        self._values.pop(station, None)
        if len(self._values) >= MAX_STATIONS:
            del self._values[next(iter(self._values))]
        self._values[station] = value

    def drop(self, station: Station) -> None:
        """Forget one station."""
        self._values.pop(station, None)

    def forget(self, peer: Peer) -> None:
        """Forget all stations behind a peer."""
        self._values = {station: value for station, value in self._values.items() if station.peer != peer}
