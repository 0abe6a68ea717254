"""What a vehicle's services may know of it at one tick: plain values, taken under the vehicle's lock."""

from dataclasses import dataclass
from enum import IntEnum

from sitl.modes import Mode


class LandedState(IntEnum):
    """MAV_LANDED_STATE."""

    ON_GROUND = 1
    IN_AIR = 2
    TAKING_OFF = 3
    LANDING = 4


class Breach(IntEnum):
    """FENCE_BREACH: which fence has been crossed."""

    NONE = 0
    MINALT = 1
    MAXALT = 2
    BOUNDARY = 3


@dataclass(frozen=True)
class Snapshot:
    """State of one simulated vehicle. SI units; local frame (x east, y north, z above the datum); angles in radians.

    Attributes:
        time_s: simulated time since the swarm's clock was released (tick times 0.04 s).
        mode, armed, airborne: flight state; airborne from launch on.
        position_m: (x, y, z).
        ground_velocity_m_s: (east, north, up).
        airspeed_m_s, climb_angle, heading: V, gamma and chi of the air velocity; heading anticlockwise from +x.
        bank: phi, positive turning left (towards growing chi).
        thrust_fraction: thrust over the most there is at this airspeed, 0 to 1.
        wind_m_s: (east, north, up), gusts included.
        airspeed_wanted_m_s: the current leg's DO_CHANGE_SPEED value.
        current_seq: mission item being flown (0 before launch).
        mission_complete: the last waypoint has been reached; the vehicle loiters at the end of its mission.
        cross_track_m, altitude_error_m, along_track_m: e_n (positive left), e_h and the deviation e = s - s_ref.
        distance_to_waypoint_m: along the path to the current item.
        landed: on the ground, in the air, or on the way from one to the other.
        home_m: (x, y, z) of home.
        ready: the pre-arm checks pass, or it is armed.
        failsafe: the station is lost, or a fence breached, and it does what is set for that.
        in_formation: it flies its schedule, and neighbours' corrections count.
        schedule_shift_s: by how much the swarm's clock is ahead of its time; None where it has none.
        formation_delay_s: of the neighbours' corrections; in real time, as measured.
        late_samples, lost_samples: of theirs, so far; None in lockstep.
        fence_enabled: a fence is heeded.
        breach_status: it is outside its fence now.
        breach_count: how often it has gone outside.
        breach_type: which fence it crossed last.
        breach_time_s: simulated time at which it did.
    """

    time_s: float
    mode: Mode
    armed: bool
    airborne: bool
    position_m: tuple[float, float, float]
    ground_velocity_m_s: tuple[float, float, float]
    airspeed_m_s: float
    climb_angle: float
    heading: float
    bank: float
    thrust_fraction: float
    wind_m_s: tuple[float, float, float]
    airspeed_wanted_m_s: float
    current_seq: int
    mission_complete: bool
    cross_track_m: float
    altitude_error_m: float
    along_track_m: float
    distance_to_waypoint_m: float
    landed: LandedState = LandedState.ON_GROUND
    home_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    ready: bool = True
    failsafe: bool = False
    in_formation: bool = False
    schedule_shift_s: float | None = None
    formation_delay_s: float = 0.0
    late_samples: int | None = None
    lost_samples: int | None = None
    fence_enabled: bool = False
    breach_status: bool = False
    breach_count: int = 0
    breach_type: Breach = Breach.NONE
    breach_time_s: float = 0.0
