"""`python -m fem DECK.bdf`."""

from fem.cli import main

if __name__ == "__main__":
    main()
