"""Campaigns: many landings, the stress of every element, and what covers them all."""
