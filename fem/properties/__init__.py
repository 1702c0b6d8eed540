"""Materials, laminates and shell sections."""
