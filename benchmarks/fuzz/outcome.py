"""How an attempt ends."""

from enum import Enum


class Outcome(Enum):
    """A message to the user, a right answer, or neither."""

    message = "message"
    right = "right"
    bad = "bad"
