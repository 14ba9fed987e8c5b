"""What processes write and what is typed to them: streams, terminals, attachments, the event stream."""
