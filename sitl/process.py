"""One process of endpoints: meets its neighbours, flies tick by tick, closes everything."""

import contextlib
import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection

import zenoh

from missions.errors import InputError
from sitl.avoidance.intent import PERIOD_TICKS
from sitl.avoidance.intent_exchange import IntentExchange
from sitl.clock import Clock, serve_clock
from sitl.crew import Crew, reason
from sitl.ending import Ending
from sitl.endpoint import Endpoint, EndpointConfig
from sitl.formation.exchange import Exchange
from sitl.formation.live_exchange import LiveExchange
from sitl.loss_agreement import LossAgreement
from sitl.loss_exchange import agree_over_zenoh
from sitl.network_queryable import serve_network
from sitl.reports import Ended, Failed, Ready
from sitl.serving import serving
from sitl.ticks import TICK_S
from sitl.zenoh_session import Peer, alive_key, discard_sockets, open_session

NEIGHBOURS_TIMEOUT_S = 30.0
OTHERS_TIMEOUT_S = 1.0
"""Who is not there by now is flown without, when a process is started again in flight."""
PATIENCE_TICKS = round(10.0 / TICK_S)
"""In real time, where who is silent may be back, nobody's place is given away sooner."""
KNOWN_TICKS = 25
"""How often vehicles are told what has come of their links."""


@dataclass(frozen=True)
class ProcessConfig:
    """One process.

    Attributes:
        endpoints: of its vehicles; they are in one network, and begin at one tick.
        swarm: the name in the swarm's Zenoh keys.
        peer: where its Zenoh session listens and connects.
        held: whether its clock starts held.
        speed: factor of its clock; infinite for as fast as it goes.
        real_time: its clock is the wall's, and it waits for nobody.
    """

    endpoints: tuple[EndpointConfig, ...]
    swarm: str
    peer: Peer
    held: bool
    speed: float = math.inf
    real_time: bool = False


def run_process(config: ProcessConfig, endpoints: Sequence[Endpoint], reports: Connection) -> None:
    """Fly vehicles until their clock is stopped, they are told to terminate, or who started them has gone.

    Args:
        config: of the process.
        endpoints: its vehicles.
        reports: where the station hears of them.
    """

    def end_at_once() -> None:
        discard_sockets(config.peer)
        os._exit(1)

    ending = Ending(end_at_once)
    try:
        _serve(config, endpoints, reports, ending)
    except Exception as error:  # whatever it was, the station is to know why it lost its vehicles
        sysids = [endpoint.vehicle.sysid for endpoint in config.endpoints]
        why = reason(sysids[0], error)
        with contextlib.suppress(OSError):
            for sysid in sysids:
                reports.send(Failed(sysid, why))
    discard_sockets(config.peer)


def _serve(config: ProcessConfig, endpoints: Sequence[Endpoint], reports: Connection, ending: Ending) -> None:
    with open_session(config.peer, real_time=config.real_time) as session:
        clock = Clock(held=config.held, speed=config.speed, real_time=config.real_time)
        exchange = _exchange(config, session, endpoints, clock)
        intents = _intents(config, session, clock)
        agreement = _agreement(config, session, exchange)

        def on_stop() -> None:
            exchange.stop()
            if intents is not None:
                intents.stop()

        clock.on_stop = on_stop
        clock.tick = config.endpoints[0].start_tick
        ending.stop = clock.stop
        alive: dict[int, zenoh.LivelinessToken] = {}

        def on_left(sysid: int, flying: int) -> None:
            alive[sysid].undeclare()
            if not flying:
                clock.stop()

        crew = Crew(endpoints, reports, on_left)
        serve_clock(session, config.swarm, lambda: crew.flying, clock)
        serve_network(session, config.swarm, lambda: crew.flying)
        for endpoint in endpoints:
            alive[endpoint.sysid] = session.liveliness().declare_token(alive_key(config.swarm, endpoint.sysid))
        if missing := exchange.wait_for_neighbours(NEIGHBOURS_TIMEOUT_S):
            raise InputError(f"heard nothing of vehicles {sorted(missing)} over Zenoh")
        if intents is not None:
            begins = clock.tick == 0
            missing = intents.wait_for_others(NEIGHBOURS_TIMEOUT_S if begins else OTHERS_TIMEOUT_S)
            if begins and missing:
                raise InputError(f"heard nothing of vehicles {sorted(missing)} over Zenoh")

        with serving(crew):
            for endpoint in endpoints:
                crew.report(Ready(endpoint.sysid, endpoint.links.tcp_port, endpoint.links.udp_port))
            _fly(crew, exchange, intents, agreement, clock, config)
        for endpoint in endpoints:
            try:
                endpoint.close()
            except OSError as error:
                crew.leave(endpoint, error)
        for endpoint in crew.flying.values():
            alive[endpoint.sysid].undeclare()
            links = exchange.reports(endpoint.sysid) + (intents.reports(endpoint.sysid) if intents else ())
            edges, yieldings, losses = endpoint.edges(), endpoint.yieldings(), endpoint.losses()
            crew.report(Ended(endpoint.sysid, endpoint.tick, links, clock.most_behind_s, edges, yieldings, losses))


def _exchange(config: ProcessConfig, session: zenoh.Session, endpoints: Sequence[Endpoint], clock: Clock) -> Exchange:
    vehicle = config.endpoints[0].vehicle
    delays = {endpoint.sysid: endpoint.delays for endpoint in endpoints}
    if config.real_time:
        return LiveExchange(session, config.swarm, delays, vehicle.network, vehicle.seed, clock.now_ticks)
    last_ticks = {sysid: tick - 1 for sysid, tick in vehicle.network.deaths.items()}
    return Exchange(session, config.swarm, delays, last_ticks)


def _intents(config: ProcessConfig, session: zenoh.Session, clock: Clock) -> IntentExchange | None:
    vehicle = config.endpoints[0].vehicle
    if vehicle.avoid_m is None:
        return None
    here = [endpoint.vehicle.sysid for endpoint in config.endpoints]
    now_ticks = clock.now_ticks if config.real_time else None
    return IntentExchange(session, config.swarm, here, vehicle.network, now_ticks)


def _agreement(config: ProcessConfig, session: zenoh.Session, exchange: Exchange) -> LossAgreement | None:
    vehicle = config.endpoints[0].vehicle
    if vehicle.reassign is None:
        return None
    here = [endpoint.vehicle.sysid for endpoint in config.endpoints]
    patience_ticks = PATIENCE_TICKS if config.real_time else 0
    return agree_over_zenoh(session, config.swarm, here, vehicle.network.sysids, exchange.inbox, patience_ticks)


def _fly(
    crew: Crew,
    exchange: Exchange,
    intents: IntentExchange | None,
    agreement: LossAgreement | None,
    clock: Clock,
    config: ProcessConfig,
) -> None:
    """Tick by tick until the clock is stopped."""
    first = config.endpoints[0]
    tick, lookahead_ticks = first.start_tick, first.vehicle.network.lookahead_ticks
    everyone, lost, fallen = crew.flying.keys(), set[int](), set[int]()

    def missing() -> set[int]:
        return exchange.gone | {i for i in everyone - crew.flying.keys() if i not in fallen}

    if agreement is not None:
        # Others may wait for this process's word while it waits for their samples.
        exchange.on_gone = lambda: agreement.miss(missing(), tick)
    while clock.wait_for(tick):
        # A neighbour needs a sample only so many ticks later: as fast as it goes, that many share a message. The first
        # goes at once, since after a restart the neighbours wait for it.
        publish_now = clock.paced or (tick + 1) % lookahead_ticks == 0 or tick == first.start_tick
        for endpoint in crew.flying.values():
            if endpoint.death_tick <= tick:
                fallen.add(endpoint.sysid)
                crew.fall(endpoint)
        for endpoint in crew.flying.values():
            try:
                exchange.publish(endpoint.observe(), now=publish_now)
                if intents is not None and tick % PERIOD_TICKS == 0:
                    intents.publish(endpoint.intent())
            except Exception as error:
                crew.leave(endpoint, error)
        exchange.gather(tick)
        if intents is not None and tick % PERIOD_TICKS == 0:
            intents.gather(tick)
        loss = None
        if agreement is not None:
            agreement.miss(missing(), tick)
            if not config.real_time:
                exchange.wait_until(agreement.is_settled)
            loss = agreement.agreed()
        now_lost = missing()
        if clock.stopped:
            return
        for endpoint in crew.flying.values():
            try:
                if now_lost != lost:
                    endpoint.notice(now_lost, lost)
                    exchange.listen(endpoint.sysid, endpoint.delays)
                if loss is not None:
                    endpoint.count_lost(loss)
                if intents is not None and tick % PERIOD_TICKS == 0:
                    endpoint.learn(intents.take(endpoint.sysid), now_lost)
                endpoint.advance(exchange.heard_by(endpoint.sysid))
                if tick % KNOWN_TICKS == 0:
                    complaints = exchange.complaints(endpoint.sysid) + (intents.complaints() if intents else [])
                    endpoint.know(exchange.reports(endpoint.sysid), complaints)
            except Exception as error:
                crew.leave(endpoint, error)
        lost = now_lost
        tick += 1
