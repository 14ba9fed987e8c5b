"""What nodes say of themselves: the parameters that they declare, and the topics, services and actions they use."""
