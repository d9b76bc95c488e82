"""The address under which people reach the server when that is not its own: that of a proxy, or a name in DNS."""

from dataclasses import dataclass
from urllib.parse import urlsplit


class BadPublicUrl(ValueError):
    """No such address can be; the message says what one looks like."""


@dataclass(frozen=True, slots=True)
class PublicUrl:
    """Scheme, host and port."""

    origin: str
    """As a browser sends it: small letters, and no port where it is the scheme's own."""
    host: str
    """The name or address alone."""


_PORTS = {"http": 80, "https": 443}


def parse_public_url(text: str) -> PublicUrl:
    """Of an address such as https://bench.example.com, with a port or without."""
    how = f"--public-url {text}: write it like https://bench.example.com or http://192.0.2.7:8700"
    try:
        url = urlsplit(text.strip())
        host, port = url.hostname, url.port
        host = host.encode("idna").decode() if host and not host.isascii() else host
    except ValueError as error:
        raise BadPublicUrl(f"{how} ({error})") from error
    if url.scheme not in _PORTS or not host:
        raise BadPublicUrl(how)
    if url.path not in ("", "/") or url.query or url.fragment or url.username is not None:
        raise BadPublicUrl(f"{how}: the page is at the root of its host, so nothing follows the host and port")
    shown = f"[{host}]" if ":" in host else host
    place = shown if port is None or port == _PORTS[url.scheme] else f"{shown}:{port}"
    return PublicUrl(f"{url.scheme}://{place}", host)
