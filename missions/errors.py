"""Errors that a user can mend: one line that names the file, key, item or vehicle, and says what to do."""


class InputError(Exception):
    """Input that cannot be used: a bad scenario, file, option or plan. The command line exits with 2."""
