"""What all tests of the package need."""

import signal

import pytest


@pytest.fixture(autouse=True)
def interruptible():
    """A shell starts jobs in the background with interrupts ignored, and nothing would end these tests."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)
