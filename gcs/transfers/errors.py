"""What went wrong with a transfer."""


class TransferError(Exception):
    """A transfer that did not succeed: one line that names the vehicle, the item and what was last heard."""
