"""``python -m symdh`` is ``symdh``."""

from __future__ import annotations

from symdh.cli.main import main

if __name__ == "__main__":
    main()
