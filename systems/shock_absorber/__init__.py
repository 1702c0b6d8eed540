"""Shock absorbers: gas, oil, friction, stops."""
