"""Cars that drive freely on the proving ground."""
