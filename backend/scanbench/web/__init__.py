"""HTTP and WebSocket: translators between browsers and sessions."""
