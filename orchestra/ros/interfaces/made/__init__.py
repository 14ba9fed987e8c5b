"""Classes of messages, services and actions made of their definitions, with type support, without a compiler."""
