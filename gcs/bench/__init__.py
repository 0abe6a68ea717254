"""Measuring Skein's stations and endpoints against other people's."""
