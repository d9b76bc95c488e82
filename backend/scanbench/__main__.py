"""`python -m scanbench`: the same as `scanbench`."""

from scanbench.cli import main

if __name__ == "__main__":
    main()
