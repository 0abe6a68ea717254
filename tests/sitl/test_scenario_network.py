"""From a scenario's tables to the network that its vehicles fly in."""

import pytest

from missions.scenario import Scenario
from missions.scenario.network import ChannelModel, FailureModel, LinkModel
from sitl.formation.channel import Channel
from sitl.formation.failures import FOR_EVER, Failure
from sitl.scenario_network import network_of


def changed(vee: Scenario) -> Scenario:
    """The V with a custom graph, a lossy channel, a link of its own and two failures."""
    channel = ChannelModel.model_validate({"jitter_s": 0.1, "loss": 0.2, "bursts": {"every_s": 4.0, "length_s": 0.4}})
    return vee.model_copy(
        update={
            "formation": vee.formation.model_copy(update={"graph": ((1, 2), (3, 2)), "stale_s": 1.0}),
            "channel": channel,
            "links": (LinkModel.model_validate({"from": 1, "to": 2, "delay_s": 0.41, "loss": 0.0}),),
            "failures": (
                FailureModel(what="kill", at_s=10.0, vehicles=(3,)),
                FailureModel(what="split", at_s=1.0, for_s=2.0, groups=((1,), (2, 3))),
            ),
        }
    )


def test_times_become_whole_ticks_and_means_chances(vee: Scenario) -> None:
    network = network_of(changed(vee), [1, 2, 3], 0.2)
    assert network.graph == ((1, 2), (2, 3))
    assert network.channel == pytest.approx(Channel(5, 3, 0.2, enter=0.01, leave=0.1, burst_loss=1.0))
    assert network.channel_of(1, 2) == pytest.approx(Channel(11, 3, 0.0, enter=0.01, leave=0.1, burst_loss=1.0))
    assert network.channel_of(2, 1) == network.channel
    assert network.failures[0] == Failure("kill", frozenset({3}), (), (250, FOR_EVER))
    assert network.failures[1] == Failure("split", frozenset(), (frozenset({1}), frozenset({2, 3})), (25, 75))
    assert (network.stale_ticks, network.lookahead_ticks) == (25, 5)
    assert network.deaths == {3: 250}


def test_who_is_killed_is_known_to_be_gone_once_its_last_sample_is_too_old(vee: Scenario) -> None:
    network = network_of(changed(vee), [1, 2, 3], 0.2)
    assert network.epochs == ((0, frozenset()), (250 + 11 + 3 + 25, frozenset({3})))
    assert network.gone_at(288) == frozenset()
    assert network.gone_at(289) == {3}


def test_shifted_system_ids_keep_graph_links_and_failures(vee: Scenario) -> None:
    network = network_of(changed(vee), [101, 102, 103], 0.2, shift=100)
    assert network.graph == ((101, 102), (102, 103))
    assert network.channel_of(101, 102).delay_ticks == 11
    assert network.deaths == {103: 250}
    assert network.failures[1].groups == (frozenset({101}), frozenset({102, 103}))


def test_failures_and_links_do_not_fail_who_has_none(vee: Scenario) -> None:
    network = network_of(vee, [vehicle.sysid for vehicle in vee.vehicles], 0.2)
    assert network.channel.certain
    assert (network.failures, dict(network.links), network.epochs) == ((), {}, ((0, frozenset()),))
