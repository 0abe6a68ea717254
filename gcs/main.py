"""Entry point of the `skein` command.

Every endpoint's process imports this file again, so it imports nothing at the top.
"""


def main() -> None:
    """Run the command line."""
    from gcs.cli import app

    app()


if __name__ == "__main__":
    main()
