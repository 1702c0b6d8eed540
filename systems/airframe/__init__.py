"""The flexible airframe and what follows from its modes."""
