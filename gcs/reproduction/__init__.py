"""The paper's figures 4 to 12 and its tables 3 and 6, made again."""

from gcs.reproduction.distances import Distance, distances
from gcs.reproduction.flown import Flown, fly_for_the_record
from gcs.reproduction.reproduced import Reproduced
from gcs.reproduction.summary import summary

__all__ = ["Distance", "Flown", "Reproduced", "distances", "fly_for_the_record", "summary"]
