"""The full model under the attachment loads: transient, decks, rival practices."""
