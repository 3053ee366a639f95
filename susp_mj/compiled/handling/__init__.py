"""The car that drives freely, compiled: memory, order of calls, virtual work. Laws stand beside their descriptions."""
