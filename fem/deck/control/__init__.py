"""What a deck asks for: executive control, case control, parameters."""
