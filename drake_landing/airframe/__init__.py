"""From a deck to the modal body: the aircraft, its modes, and which of them matter."""
