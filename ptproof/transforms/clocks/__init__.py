"""Changes of time: clocks that check themselves, the named ones, a cap on the rate of any of them."""
