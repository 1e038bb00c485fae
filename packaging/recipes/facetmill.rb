class Facetmill < Formula
  desc "Declarative mesh pipelines that end in checked glTF"
  homepage "https://github.com/OWNER/facetmill"
  version "0.4.0"
  license "GPL-3.0-or-later"

  on_linux do
    on_intel do
      url "https://github.com/OWNER/facetmill/releases/download/v0.4.0/facetmill-0.4.0-linux-x86_64"
      sha256 "SHA256"
    end
    on_arm do
      url "https://github.com/OWNER/facetmill/releases/download/v0.4.0/facetmill-0.4.0-linux-aarch64"
      sha256 "SHA256"
    end
  end

  def install
    bin.install Dir["facetmill-*"].first => "facetmill"
    generate_completions_from_executable(bin/"facetmill", "completions")
  end

  test do
    system bin/"facetmill", "pipe", "generate", "cube", "!", "validate", "--closed"
  end
end
