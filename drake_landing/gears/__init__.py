"""Landing gears: their data, bodies, holds, and the systems that make them work."""
