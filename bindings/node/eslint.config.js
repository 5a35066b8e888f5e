// SPDX-License-Identifier: BSD-3-Clause
import tseslint from 'typescript-eslint';

export default tseslint.config(
  { ignores: ['dist', 'dist-test', 'eslint.config.js'] },
  tseslint.configs.strictTypeChecked,
  tseslint.configs.stylisticTypeChecked,
  {
    languageOptions: { parserOptions: { project: ['tsconfig.json', 'test/tsconfig.json'] } },
    linterOptions: { reportUnusedDisableDirectives: 'error' },
    rules: {
      // JavaScript calls this, too: what the types exclude is checked all the same.
      '@typescript-eslint/no-unnecessary-condition': 'off',
      // A library that is newer may give a value that has no name yet; it stays a number.
      '@typescript-eslint/no-unsafe-enum-assignment': 'off',
      // It asks for what no-non-null-assertion forbids.
      '@typescript-eslint/non-nullable-type-assertion-style': 'off',
      '@typescript-eslint/no-unused-vars': ['error', { varsIgnorePattern: '^_$' }],
    },
  },
  {
    files: ['test/**'],
    rules: {
      // Tests pass wrong types on purpose, and read files whose type they state.
      '@typescript-eslint/no-unnecessary-type-parameters': 'off',
      // node:test awaits its tests by itself.
      '@typescript-eslint/no-floating-promises': [
        'error',
        { allowForKnownSafeCalls: [{ from: 'package', name: ['test', 'default'], package: 'node:test' }] },
      ],
    },
  },
);
