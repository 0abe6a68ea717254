"""Campaigns: one plan rehearsed many times, over seeds of the gusts and over keys of the scenario."""
