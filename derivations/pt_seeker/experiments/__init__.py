"""What the paper does with its examples: simulations, observed over all headings, and the figures of Section 7."""
