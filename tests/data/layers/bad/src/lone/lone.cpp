int lone;
