"""A flight as one HTML file that needs no network: `skein report`."""

from gcs.report_page.flown_run import FlownRun, read_flown_run
from gcs.report_page.page import write_page

__all__ = ["FlownRun", "read_flown_run", "write_page"]
