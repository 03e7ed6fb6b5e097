return require "clench.first.a"
