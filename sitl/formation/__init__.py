"""The formation: who hears whom, the law (15) on along-track deviations, and its delay margin."""
