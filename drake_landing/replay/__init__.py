"""The landing to look at, without a server."""
