"""Certificates of a Zenoh session: checked before they are used, since Zenoh says only that it could not connect."""

import contextlib
import socket
import ssl
from dataclasses import dataclass
from pathlib import Path

from missions.errors import InputError

PROBE_S = 3.0
"""To find out why a router refuses."""


@dataclass(frozen=True)
class Tls:
    """What a session proves itself with, and whom it believes: files in PEM.

    Attributes:
        ca: certificate that signed those of all.
        certificate, key: its own.
    """

    ca: Path
    certificate: Path
    key: Path

    def settings(self) -> dict[str, object]:
        """Of Zenoh, under transport/link/tls: both ends show a certificate."""
        return {
            "root_ca_certificate": str(self.ca),
            "enable_mtls": True,
            "connect_certificate": str(self.certificate),
            "connect_private_key": str(self.key),
            "listen_certificate": str(self.certificate),
            "listen_private_key": str(self.key),
        }

    def context(self) -> ssl.SSLContext:
        """The same for a socket.

        Raises:
            InputError: a file is missing or is no such thing, or certificate and key are not of each other.
        """
        for file in (self.ca, self.certificate, self.key):
            if not file.is_file():
                raise InputError(f"{file}: no such file")
        context = ssl.create_default_context()
        try:
            context.load_verify_locations(self.ca)
        except ssl.SSLError as error:
            raise InputError(f"{self.ca}: no certificate in PEM ({error.reason})") from None
        try:
            context.load_cert_chain(self.certificate, self.key)
        except ssl.SSLError as error:
            raise InputError(f"{self.certificate} and {self.key} do not fit each other ({error.reason})") from None
        return context


def why_refused(host: str, port: int, tls: Tls | None) -> str:
    """Why no session comes about with a router, for people."""
    try:
        with contextlib.closing(socket.create_connection((host, port), PROBE_S)) as plain:
            if tls is None:
                return "someone listens there, but no Zenoh router without certificates"
            with tls.context().wrap_socket(plain, server_hostname=host) as secure:
                secure.recv(1)
    except ssl.SSLCertVerificationError as error:
        return f"its certificate is not signed by {tls.ca if tls else 'anyone'} ({error.verify_message})"
    except ssl.SSLError as error:
        return f"it does not accept {tls.certificate if tls else 'us'} ({error.reason})"
    except OSError as error:
        return f"no router answers there ({error.strerror or error}); `skein router` runs one"
    return "it closes the connection"
