"""The formation: who hears whom, the law (15) on along-track deviations, its delay margin and gains for a delay."""
