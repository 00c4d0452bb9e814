"""One module a command. What a command needs is imported when it runs, not when `--help` does."""
