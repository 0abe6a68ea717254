"""From who is lost to who flies what: a pure function, the same in the station, the rehearsal and each vehicle."""

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from missions.reassignment import Gap, Loss, Move, Reassigned
from missions.reference import Reference, spliced
from missions.reference.reference import fillet_radius_m
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from planner.reassign.assignment import assigned, kept, ranks
from planner.reassign.safety import fault, leg_fault

NOTICE_S = 2.0
"""From a loss on nothing changes for so long, so that all know of it;"""
LEAD_S = 10.0
"""and from a vehicle's taking over a new reference on until that begins to differ from the old one."""
STEP_S = 5.0
"""Between the beginnings that are tried."""
CLOSING_M_S = (2.0, 4.0)
"""How fast the one with the longest way draws near to its place: gently if that is safe, else faster."""
SHORTEST_S = 20.0
"""Even a short way takes so long: speeds change over 8 s at either end."""


@dataclass(frozen=True)
class Standing:
    """How things stand after some losses.

    Attributes:
        found: what they have led to.
        references: what each vehicle flies.
        places: of those that are not gone, by sysid.
        settled_s: when the last move has ended.
    """

    found: Reassigned
    references: Mapping[int, Reference]
    places: Mapping[int, int]
    settled_s: float = 0.0


@dataclass(frozen=True)
class Reassigner:
    """Finds what losses lead to, for a plan that verifies; remembers what it has found."""

    scenario: Scenario
    plan: FormationPlan
    _known: dict[tuple[Loss, ...], Standing] = field(default_factory=dict, compare=False, repr=False)

    def __call__(self, losses: Sequence[Loss]) -> Reassigned:
        """What losses, in order of time, lead to."""
        return self._standing(tuple(losses)).found

    def _standing(self, losses: tuple[Loss, ...]) -> Standing:
        if losses not in self._known:
            if losses:
                standing = self._after(losses[-1], self._standing(losses[:-1]))
            else:
                references = self.plan.references(self.scenario)
                standing = Standing(Reassigned(), references, {sysid: sysid for sysid in references})
            self._known[losses] = standing
        return self._known[losses]

    def _after(self, loss: Loss, before: Standing) -> Standing:
        """The soonest safe moves that leave no gap; how things stood, with the gaps, when there are none."""
        places = {sysid: place for sysid, place in before.places.items() if sysid not in loss.gone}
        standing = replace(before, places=places)
        rank_of = ranks(self.scenario)
        certain, possible = kept(rank_of, len(places))
        flown = set(places.values())
        if set(certain) <= flown <= {*certain, *possible}:
            return standing
        empty = sorted(set(certain) - flown) or sorted(set(possible) - flown)
        planned, first_fault = self._standing(()).references, None
        for start_s in self._starts_s(loss, standing):
            sysids = sorted(places)
            from_m = np.array([standing.references[sysid].positions(np.array(start_s)) for sysid in sysids])
            to_m = np.array([planned[place].positions(np.array(start_s)) for place in certain + possible])
            chosen = assigned(from_m, to_m, len(certain))
            wanted = {
                sysid: (certain + possible)[k]
                for sysid, k in zip(sysids, chosen.tolist(), strict=True)
                if (certain + possible)[k] != places[sysid]
            }
            longest_m = float(np.linalg.norm(to_m[chosen] - from_m, axis=1).max())
            for closing_m_s in CLOSING_M_S:
                end_s = start_s + max(SHORTEST_S, longest_m / closing_m_s)
                moves, why = self._moves(wanted, standing, start_s, end_s)
                if why is None:
                    found = replace(standing.found, moves=standing.found.moves + moves)
                    references = dict(standing.references) | {move.sysid: move.reference for move in moves}
                    return Standing(found, references, places | wanted, end_s)
                first_fault = first_fault or why
        if not first_fault:  # they are about to arrive
            return standing
        gaps = tuple(Gap(loss.t_s, place, first_fault) for place in empty)
        return replace(standing, found=replace(standing.found, gaps=standing.found.gaps + gaps))

    def _starts_s(self, loss: Loss, standing: Standing) -> Iterator[float]:
        """Moments at which moves may begin: nobody is at another one, frozen, or about to arrive."""
        freezes = [
            (one.at_s, one.at_s + (one.for_s or 0.0))
            for one in self.scenario.failures
            if one.what == "freeze" and set(one.vehicles) & standing.places.keys()
        ]
        last_s = min(standing.references[sysid].duration_s for sysid in standing.places)
        for k in itertools.count():
            start_s = max(loss.t_s + NOTICE_S, standing.settled_s) + LEAD_S + k * STEP_S
            if start_s + SHORTEST_S > last_s:
                return
            if not any(begin - SHORTEST_S < start_s < end + LEAD_S for begin, end in freezes):
                yield start_s

    def _moves(
        self, wanted: Mapping[int, int], standing: Standing, start_s: float, end_s: float
    ) -> tuple[tuple[Move, ...], str | None]:
        """Vehicles' moves to the places that are wanted of them, and what is wrong with them."""
        planned, wind = self._standing(()).references, self.scenario.wind.forecast_m_s
        names = {vehicle.sysid: vehicle.name for vehicle in self.scenario.vehicles}
        moves = []
        for sysid, place in sorted(wanted.items()):
            own, other = standing.references[sysid], planned[place]
            fastest = max(
                _speed_m_s(own, start_s), _speed_m_s(other, end_s), _mean_speed_m_s(own, other, start_s, end_s)
            )
            try:
                reference = spliced(own, other, start_s, end_s, fillet_radius_m(fastest), wind)
            except ValueError as error:
                return (), f"{names[sysid]} {error}"
            if why := leg_fault(reference, (start_s + end_s) / 2, self.scenario):
                return (), f"{names[sysid]}: {why}"
            mission = self.plan.missions[place]
            moves.append(Move(sysid, place, start_s - LEAD_S, start_s, end_s, reference, mission))
        flown = dict(standing.references) | {move.sysid: move.reference for move in moves}
        return tuple(moves), fault({sysid: flown[sysid] for sysid in standing.places}, self.scenario)


def _speed_m_s(reference: Reference, t_s: float) -> float:
    before, after = reference.arc_lengths(np.array([t_s - 0.5, t_s + 0.5]))
    return float(after - before)


def _mean_speed_m_s(own: Reference, other: Reference, start_s: float, end_s: float) -> float:
    way = other.positions(np.array(end_s)) - own.positions(np.array(start_s))
    return float(np.hypot(way[0], way[1])) / (end_s - start_s)
