{ lib, stdenvNoCC, fetchurl }:
let
  version = "0.4.0";
  programs = {
    x86_64-linux = { name = "x86_64"; hash = lib.fakeHash; };
    aarch64-linux = { name = "aarch64"; hash = lib.fakeHash; };
  };
  program = programs.${stdenvNoCC.hostPlatform.system};
in stdenvNoCC.mkDerivation {
  pname = "facetmill";
  inherit version;
  src = fetchurl {
    url = "https://github.com/OWNER/facetmill/releases/download/v${version}/facetmill-${version}-linux-${program.name}";
    inherit (program) hash;
  };
  dontUnpack = true;
  installPhase = "install -Dm755 $src $out/bin/facetmill";
  meta = {
    description = "Declarative mesh pipelines that end in checked glTF";
    homepage = "https://github.com/OWNER/facetmill";
    license = lib.licenses.gpl3Plus;
    platforms = lib.attrNames programs;
    mainProgram = "facetmill";
  };
}
